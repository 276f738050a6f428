#include "run/work_folder.h"
#include "support/temporary_folder.h"
#include "support/usual_signals.h"
#include "vcarve/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <optional>
#include <vector>

namespace vcarve::work_folder_test {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

const Job kJob = {{"points3D.bin", "12 bytes"}, {"--quality", "1"}};

using Numbers = std::vector<std::uint32_t>;

class Work : public ::testing::Test {
  protected:
    /// Leaves a folder with one finished stage.
    void leave_a_stage() const
    {
        WorkFolder work(path);
        work.begin(kJob);
        work.save("numbers", Numbers{1, 2, 3});
    }
    std::string refusal_to_begin(const Job& job) const
    {
        return refusal<InputError>([&] { WorkFolder(path).begin(job); });
    }
    Numbers numbers() const
    {
        WorkFolder work(path);
        work.begin(kJob);
        Numbers numbers;
        work.load("numbers", numbers);
        return numbers;
    }

    TemporaryFolder folder;
    fs::path path = folder / "work";
};

/// Limits the size of files to `bytes` while the object exists.
class LimitedFiles {
  public:
    explicit LimitedFiles(rlim_t bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        const rlimit limit = {bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
    }
    LimitedFiles(const LimitedFiles&) = delete;
    LimitedFiles& operator=(const LimitedFiles&) = delete;
    ~LimitedFiles()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_ = {};
    void (*handler_)(int) = nullptr;
};

} // namespace

TEST_F(Work, IsLedByOneProcessAndSharedByOthers)
{
    std::optional<WorkFolder> work(path);
    work->begin(kJob);
    WorkFolder shared(path);
    shared.begin(kJob);
    EXPECT_TRUE(work->leads());
    EXPECT_FALSE(shared.leads() || shared.try_lead());
    shared.save("one", Numbers{4});
    shared.clear(); // does nothing
    EXPECT_TRUE(work->has("one"));
    WorkFolder other(path);
    EXPECT_THAT(refusal<InputError>([&] {
                    other.begin({{"--quality", "2"}});
                }),
                HasSubstr("belongs to another run"));
    work.reset(); // as if the process had died
    EXPECT_FALSE(shared.is_over());
    EXPECT_TRUE(shared.try_lead());
    EXPECT_TRUE(shared.has("one"));
    shared.clear();
    EXPECT_TRUE(other.is_over());
    EXPECT_FALSE(other.try_lead());
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(Work, IsReusedByTheNextRunOfTheSameJob)
{
    leave_a_stage();
    EXPECT_EQ(numbers(), (Numbers{1, 2, 3}));
    EXPECT_FALSE(WorkFolder(path).has("others"));
}

TEST_F(Work, IsRejectedUnchangedIfItBelongsToAnotherJob)
{
    leave_a_stage();
    const std::string job = bytes_of(path / "job");
    const std::string end = "; choose another folder with --work, or remove this one to start over";
    const std::string begin = "the work folder " + path.string() + " belongs to another run: ";
    EXPECT_EQ(refusal_to_begin({kJob[0], {"--quality", "2"}}),
              begin + "--quality was 1 and is now 2" + end);
    EXPECT_EQ(refusal_to_begin({{"points3D.bin", "13 bytes"}, kJob[1]}),
              begin + "points3D.bin was 12 bytes and is now 13 bytes" + end);
    EXPECT_EQ(refusal_to_begin({kJob[0]}), begin + "--quality was 1 and is now missing" + end);
    EXPECT_EQ(refusal_to_begin({kJob[1], kJob[0]}),
              begin + "the order of the input files differs" + end);
    EXPECT_EQ(bytes_of(path / "job"), job);
    EXPECT_EQ(numbers(), (Numbers{1, 2, 3}));
}

TEST_F(Work, IsRejectedIfItsJobIsDamaged)
{
    leave_a_stage();
    const std::string job = bytes_of(path / "job");
    for (std::size_t at = 0; at < job.size(); ++at) {
        std::string other = job;
        other[at] = static_cast<char>(other[at] ^ 1);
        std::ofstream(path / "job") << other;
        EXPECT_THAT(refusal_to_begin(kJob), HasSubstr("/job: the job record of the work folder is "
                                                      "damaged"))
            << at;
    }
    fs::resize_file(path / "job", job.size() / 2);
    EXPECT_THAT(refusal_to_begin(kJob), HasSubstr("is damaged"));
}

TEST_F(Work, AcceptsAnyJobIfItHasNoStagesAndIsRemoved)
{
    WorkFolder(path).begin(kJob);
    EXPECT_FALSE(fs::exists(path));
    fs::create_directory(path);
    WorkFolder(path).begin(kJob);
    EXPECT_TRUE(fs::is_empty(path)); // it existed before
    folder.write("work/job", "damaged");
    WorkFolder(path).begin(kJob);
    EXPECT_TRUE(fs::is_empty(path));
}

TEST_F(Work, KeepsLockFilesOfOtherPrograms)
{
    folder.write("work/lock", "mine");
    folder.write("work/notes.txt", "mine");
    for (int i = 0; i < 2; ++i) { // the first call unlocks the folder
        EXPECT_THAT(refusal<UsageError>([&] { WorkFolder other(path); }),
                    HasSubstr("is not a work folder"));
    }
    EXPECT_EQ(bytes_of(path / "lock"), "mine");
}

TEST_F(Work, IsUnlockedWhenItsProcessIsKilled)
{
    int ready[2] = {};
    ASSERT_EQ(::pipe(ready), 0);
    const pid_t child = ::fork();
    if (child == 0) {
        take_signals_as_usual();
        WorkFolder work(path);
        work.begin(kJob);
        work.save("numbers", Numbers{1, 2, 3});
        if (::write(ready[1], "x", 1) != 1) ::_exit(1);
        ::pause();
        ::_exit(0);
    }
    char letter = 0;
    ASSERT_EQ(::read(ready[0], &letter, 1), 1);
    EXPECT_FALSE(WorkFolder(path).leads());
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
    ::close(ready[0]);
    ::close(ready[1]);
    EXPECT_EQ(numbers(), (Numbers{1, 2, 3}));
}

TEST_F(Work, RejectsFoldersWithOtherFiles)
{
    folder.write("work/notes.txt", "mine");
    EXPECT_EQ(refusal<UsageError>([&] { WorkFolder other(path); }),
              path.string() +
                  " is not a work folder: it contains notes.txt; --work needs a new or empty "
                  "folder, or the work folder of an earlier run");
    EXPECT_EQ(std::distance(fs::directory_iterator(path), {}), 1);
    folder.write("file", "mine");
    EXPECT_EQ(refusal<UsageError>([&] { WorkFolder other(folder / "file"); }),
              "cannot create the work folder " + (folder / "file").string() +
                  ": a file with this name exists");
    EXPECT_EQ(refusal<UsageError>([&] { WorkFolder other(folder / "no/work"); }),
              "cannot create the work folder " + (folder / "no/work").string() +
                  ": No such file or directory");
    fs::create_symlink("loop", folder / "loop");
    for (const char* loop : {"loop", "loop/work"}) {
        EXPECT_EQ(refusal<UsageError>([&] { WorkFolder other(folder / loop); }),
                  "cannot create the work folder " + (folder / loop).string() +
                      ": Too many levels of symbolic links");
    }
    const fs::path endless = folder / std::string(300, 'n');
    EXPECT_EQ(refusal<UsageError>([&] { WorkFolder other(endless); }),
              "cannot create the work folder " + endless.string() + ": File name too long");
}

TEST_F(Work, RemovesOnlyItsFilesWhenCleared)
{
    leave_a_stage();
    {
        WorkFolder work(path);
        work.begin(kJob);
        work.clear();
    }
    EXPECT_FALSE(fs::exists(path)); // WorkFolder created it
    leave_a_stage();
    folder.write("work/notes.txt", "mine");
    WorkFolder work(path);
    work.begin(kJob);
    work.clear();
    EXPECT_EQ(std::distance(fs::directory_iterator(path), {}), 1);
    EXPECT_TRUE(fs::exists(path / "notes.txt"));
}

TEST_F(Work, IsRemovedIfItsCreatorWasKilledBeforeItBegan)
{
    const pid_t child = ::fork();
    if (child == 0) {
        const WorkFolder work(path);
        ::_exit(0);
    }
    ::waitpid(child, nullptr, 0);
    EXPECT_TRUE(fs::exists(path));
    WorkFolder(path).begin(kJob);
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(Work, RemovesIncompleteFilesOfAKilledRunWhenCleared)
{
    leave_a_stage();
    folder.write("work/others.stage.part-123", "half");
    folder.write("work/job.part-123", "half");
    folder.write("work/my.part-123", "mine");
    EXPECT_EQ(numbers(), (Numbers{1, 2, 3}));
    WorkFolder work(path);
    work.begin(kJob);
    work.clear();
    EXPECT_FALSE(fs::exists(path / "others.stage.part-123"));
    EXPECT_TRUE(fs::exists(path / "my.part-123"));
}

TEST_F(Work, IsClearedFurtherIfThatWasInterrupted)
{
    leave_a_stage();
    fs::rename(path / "job", path / "job.part-ended");
    {
        WorkFolder work(path);
        work.begin(kJob);
        EXPECT_FALSE(work.is_resumed() || work.has("numbers"));
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(Work, ReportsAFullDiskAndLosesNothing)
{
    leave_a_stage();
    WorkFolder work(path);
    work.begin(kJob);
    {
        const LimitedFiles limit(100'000);
        EXPECT_EQ(refusal<UsageError>([&] { work.save("many", Numbers(1'000'000)); }),
                  "cannot write " + (path / "many.stage").string() + ": File too large");
        EXPECT_FALSE(work.has("many"));
        work.save("few", Numbers{4});
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(path), {}), 4); // lock, job, numbers, few
}

TEST_F(Work, IsClaimedByOneProcessForEachStage)
{
    WorkFolder work(path);
    work.begin(kJob);
    WorkFolder shared(path);
    shared.begin(kJob);
    {
        const FileLock one = work.claim("one");
        EXPECT_TRUE(one);
        EXPECT_FALSE(shared.claim("one"));
        EXPECT_TRUE(shared.claim("two"));
    }
    EXPECT_TRUE(shared.claim("one")) << "the claim has ended";
}

TEST_F(Work, RemovesStagesByTheirFirstLetters)
{
    WorkFolder work(path);
    work.begin(kJob);
    for (const char* const name : {"tile-0-points", "tile-1-points", "tiles"}) {
        work.save(name, Numbers{1});
    }
    work.drop_all("tile-");
    EXPECT_FALSE(work.has("tile-0-points") || work.has("tile-1-points"));
    EXPECT_TRUE(work.has("tiles"));
}

} // namespace vcarve::work_folder_test
