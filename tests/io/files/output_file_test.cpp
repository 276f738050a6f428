#include "io/files/output_file.h"
#include "support/temporary_folder.h"
#include "vcarve/error.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>

namespace vcarve::output_file_test {
namespace {

const std::string kNoNewFile = "the system allows no new file in the folder ";

namespace fs = std::filesystem;

std::string refusal_to_write(const fs::path& path)
{
    return refusal<UsageError>([&] { require_writable(path); });
}

/// Simulates a full disk: while it lives, no file of this process can grow beyond `size_bytes`.
class FullDisk {
  public:
    explicit FullDisk(rlim_t size_bytes)
    {
        ::getrlimit(RLIMIT_FSIZE, &before_);
        handler_ = std::signal(SIGXFSZ, SIG_IGN);
        const rlimit limit{size_bytes, before_.rlim_max};
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    FullDisk(const FullDisk&) = delete;
    FullDisk& operator=(const FullDisk&) = delete;
    ~FullDisk()
    {
        ::setrlimit(RLIMIT_FSIZE, &before_);
        std::signal(SIGXFSZ, handler_);
    }

  private:
    rlimit before_{};
    void (*handler_)(int) = nullptr;
};

TEST(OutputFile, AppearsUnderItsNameOnlyWhenCommitted)
{
    const TemporaryFolder folder;
    const fs::path path = folder / "out.ply";
    OutputFile file(path);
    file.stream() << "hello " << 42;
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(fs::exists(part_path(path)));
    file.commit();
    EXPECT_EQ(bytes_of(path), "hello 42");
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(OutputFile, KeepsThePermissionsOfTheFileItReplaces)
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("out.ply", "old");
    for (const unsigned mode : {0600U, 0664U, 0755U}) {
        fs::permissions(path, fs::perms(mode));
        OutputFile file(path);
        file.commit();
        EXPECT_EQ(fs::status(path).permissions(), fs::perms(mode));
    }
}

TEST(OutputFile, LeavesNoFileWithoutACommit)
{
    const TemporaryFolder folder;
    {
        OutputFile file(folder / "out.ply");
        file.stream() << "half";
    }
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(OutputFile, KeepsTheOldFileWithoutACommit)
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("out.ply", "old");
    {
        OutputFile file(path);
        file.stream() << "half";
    }
    EXPECT_EQ(bytes_of(path), "old");
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(OutputFile, ReplacesTheOldFile)
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("out.ply", "a longer old file");
    OutputFile file(path);
    file.stream() << "new";
    file.commit();
    EXPECT_EQ(bytes_of(path), "new");
}

TEST(OutputFile, KeepsEveryByteOfSmallAndLargeWrites)
{
    const TemporaryFolder folder;
    std::string expected;
    OutputFile file(folder / "out.ply");
    for (std::size_t size : {1U, 70000U, 3U, 16383U, 16384U, 65536U, 0U, 5U}) {
        const std::string block(size, static_cast<char>('a' + size % 23));
        file.stream() << block;
        file.stream().put('|');
        expected += block + '|';
    }
    file.commit();
    EXPECT_EQ(bytes_of(folder / "out.ply"), expected);
}

TEST(OutputFile, ReplacesTheTargetOfASymbolicLink)
{
    const TemporaryFolder folder;
    fs::create_directory(folder / "real");
    const fs::path real = folder.write("real/mesh.ply", "old");
    fs::create_symlink(real, folder / "link.ply");
    OutputFile file(folder / "link.ply");
    file.stream() << "new";
    file.commit();
    EXPECT_TRUE(fs::is_symlink(folder / "link.ply"));
    EXPECT_EQ(bytes_of(real), "new");
}

TEST(OutputFile, WritesADeviceDirectly)
{
    OutputFile file("/dev/null");
    file.stream() << "gone";
    file.commit();
    EXPECT_TRUE(fs::is_character_file("/dev/null"));
    EXPECT_FALSE(fs::exists(part_path("/dev/null")));
}

TEST(OutputFile, ReportsAFullDevice)
{
    const std::string message = refusal<UsageError>([] {
        OutputFile file("/dev/full");
        file.stream() << "no room";
        file.commit();
    });
    EXPECT_EQ(message, "cannot write /dev/full: No space left on device");
}

TEST(OutputFile, LeavesTheOldFileIfTheDiskFillsUp)
{
    const TemporaryFolder folder;
    const fs::path path = folder.write("out.ply", "old");
    std::string message;
    {
        const FullDisk disk(100000);
        message = refusal<UsageError>([&] {
            OutputFile file(path);
            for (int i = 0; i < 100; ++i) {
                file.stream() << std::string(10000, 'x');
            }
            file.commit();
        });
    }
    EXPECT_EQ(message, "cannot write " + path.string() + ": File too large");
    EXPECT_EQ(bytes_of(path), "old");
    EXPECT_EQ(folder.num_entries(), 1U);
}

TEST(OutputFile, OverwritesTheTemporaryFileOfADeadProcess)
{
    const TemporaryFolder folder;
    std::ofstream(part_path(folder / "out.ply")) << "left behind, and longer";
    OutputFile file(folder / "out.ply");
    file.stream() << "new";
    file.commit();
    EXPECT_EQ(bytes_of(folder / "out.ply"), "new");
}

TEST(PartPath, IsInTheFolderOfTheFileAndContainsTheProcessId)
{
    EXPECT_EQ(part_path("/nowhere/out.ply").string(),
              "/nowhere/out.ply.part-" + std::to_string(::getpid()));
}

TEST(RequireWritable, LeavesNoFileBehind)
{
    const TemporaryFolder folder;
    require_writable(folder / "out.ply");
    EXPECT_EQ(folder.num_entries(), 0U);
}

TEST(RequireWritable, ExplainsEachReasonInOneSentence)
{
    const TemporaryFolder folder;
    const std::string name = folder.path().string();
    folder.write("plain", "");
    ::mkfifo((folder / "pipe").c_str(), 0600);
    EXPECT_EQ(refusal_to_write(""), "cannot write the output: its path is empty");
    EXPECT_EQ(refusal_to_write(folder.path()), "cannot write " + name + ": it is a folder");
    EXPECT_EQ(refusal_to_write(folder / "new/"),
              "cannot write " + name + "/new/: it names a folder, not a file");
    EXPECT_EQ(refusal_to_write(folder / "no/out.ply"),
              "cannot write " + name + "/no/out.ply: the folder " + name + "/no does not exist");
    EXPECT_EQ(refusal_to_write(folder / "plain/out.ply"),
              "cannot write " + name + "/plain/out.ply: " + name + "/plain is not a folder");
    EXPECT_EQ(refusal_to_write(folder / "pipe"),
              "cannot write " + name + "/pipe: it is neither a file nor a character device");
    fs::create_symlink("loop", folder / "loop");
    const std::string circle = "Too many levels of symbolic links";
    EXPECT_EQ(refusal_to_write(folder / "loop"), "cannot write " + name + "/loop: " + circle);
    EXPECT_EQ(refusal_to_write(folder / "loop/out.ply"), "cannot write " + name +
                                                             "/loop/out.ply: " + kNoNewFile + name +
                                                             "/loop (" + circle + ")");
    EXPECT_TRUE(fs::is_symlink(folder / "loop"));
    const std::string endless(300, 'n');
    EXPECT_EQ(refusal_to_write(folder / endless), "cannot write " + name + "/" + endless + ": " +
                                                      kNoNewFile + name + " (File name too long)");
}

TEST(RequireWritable, RefusesAFolderThatAcceptsNoNewFile)
{
    // /proc accepts no new file, not even from root.
    EXPECT_EQ(refusal_to_write("/proc/out.ply"),
              "cannot write /proc/out.ply: " + kNoNewFile + "/proc (No such file or directory)");
}

} // namespace
} // namespace vcarve::output_file_test
