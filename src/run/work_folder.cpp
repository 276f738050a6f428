#include "run/work_folder.h"

#include "io/files/output_file.h"
#include "vcarve/error.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <iterator>
#include <thread>
#include <utility>
#include <vector>

namespace vcarve {

namespace fs = std::filesystem;

namespace {

constexpr const char* kLockName = "lock";
constexpr const char* kJobName = "job";
/// The name of the job's file while the folder is cleared.
constexpr const char* kEndedName = "job.part-ended";
constexpr const char* kStageEnd = ".stage";
constexpr const char* kClaimEnd = ".claim";
/// The first line of the job's file. kJobEnd begins its last line.
constexpr std::string_view kJobTitle = "work folder of colmap-vcarve, layout 1\n";
/// Content of the lock file, which is removed last, if the folder must be removed, too.
constexpr std::string_view kMadeHere = "the folder was made by the run\n";
constexpr std::string_view kJobEnd = "digest of the lines above\t";
constexpr const char* kAnother = "choose another folder with --work, or remove this one to start "
                                 "over";

/// Whether this program writes files with that name.
bool is_ours(const std::string& name)
{
    const std::string whole = name.substr(0, name.find(".part-"));
    return whole == kLockName || whole == kJobName || whole.ends_with(kStageEnd) ||
           whole.ends_with(kClaimEnd);
}

std::vector<fs::path> files_in(const fs::path& folder)
{
    std::error_code error; // a folder that cannot be listed is refused when it is written
    std::vector<fs::path> files;
    for (auto entry = fs::directory_iterator(folder, error);
         !error && entry != fs::directory_iterator(); entry.increment(error)) {
        files.push_back(entry->path());
    }
    std::ranges::sort(files);
    return files;
}

/// Returns whether it created the folder. Throws UsageError if no folder exists afterwards.
bool make_folder(const fs::path& folder)
{
    std::error_code error;
    const bool was_made = fs::create_directory(folder, error);
    std::error_code status_error;
    const fs::file_status status = fs::status(folder, status_error);
    if (fs::is_directory(status)) return was_made;
    const std::string reason = fs::exists(status)         ? "a file with this name exists"
                               : fs::status_known(status) ? error.message()
                                                          : status_error.message();
    throw UsageError(fmt::format("cannot create the work folder {}: {}", folder.string(), reason));
}

/// Throws UsageError if the folder has other files, so that they are never mixed with ours.
void require_ours(const fs::path& folder)
{
    std::error_code error; // without access to the folder, writing fails later
    if (fs::exists(folder / kJobName, error) || fs::exists(folder / kEndedName, error)) return;
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename();
        if (is_ours(name) && !name.ends_with(kStageEnd)) continue;
        throw UsageError(fmt::format("{} is not a work folder: it contains {}; --work needs a "
                                     "new or empty folder, or the work folder of an earlier "
                                     "run",
                                     folder.string(), name));
    }
}

/// Whether the path still refers to the file of this descriptor.
bool is_same_file(int descriptor, const fs::path& path)
{
    struct stat opened = {};
    struct stat named = {};
    return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
           opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

/// Opens and locks a file. Returns nothing if another process has the lock, or if the file is
/// missing and not to be made.
FileLock lock(const fs::path& path, bool makes)
{
    const auto refuse = [&](const char* what, int error) {
        throw UsageError(fmt::format("{} the work folder {}: {}", what, path.parent_path().string(),
                                     std::strerror(error)));
    };
    for (;;) {
        const int file = ::open(path.c_str(), O_RDWR | O_CLOEXEC | (makes ? O_CREAT : 0), 0666);
        if (file < 0 && errno == ENOENT && !makes) return {};
        if (file < 0) refuse("cannot write to", errno);
        FileLock held(file);
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            if (errno == EWOULDBLOCK) return {};
            refuse("cannot lock", errno);
        }
        // A run that ends removes this file, which may have been opened just before.
        if (is_same_file(file, path)) return held;
    }
}

void remove_quietly(const fs::path& path)
{
    std::error_code error; // a file that cannot be removed stays
    fs::remove(path, error);
}

/// Removes the files of a run for which is_one(name) is true.
template <typename IsOne>
void remove_ours(const fs::path& folder, const IsOne& is_one)
{
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename();
        if (is_ours(name) && is_one(name)) remove_quietly(file);
    }
}

/// Removes all files of a run but those of the lock and the job.
void remove_stages(const fs::path& folder)
{
    remove_ours(folder, [](const std::string& name) {
        return !name.starts_with(kJobName) && name != kLockName;
    });
}

std::string whole_text(const std::string& lines)
{
    return fmt::format("{}{}{}\n", lines, kJobEnd, digest_text(digest_of(lines)));
}

/// The content of a file; empty if the file is missing.
std::string text_of(const fs::path& path)
{
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// The facts in the text of a job's file. Throws InputError if it is damaged.
std::string job_lines(const fs::path& path, const std::string& text)
{
    const std::string lines = text.substr(0, std::min(text.size(), text.rfind(kJobEnd)));
    if (!lines.starts_with(kJobTitle) || text != whole_text(lines)) {
        throw InputError(fmt::format("{}: the job record of the work folder is damaged: its "
                                     "digest does not match; {}",
                                     path.string(), kAnother));
    }
    return lines.substr(kJobTitle.size());
}

Job parse_job(std::string_view lines)
{
    Job job;
    while (!lines.empty()) {
        const std::string_view line = lines.substr(0, lines.find('\n'));
        const std::size_t tab = std::min(line.find('\t'), line.size() - 1);
        job.push_back({std::string(line.substr(0, tab)), std::string(line.substr(tab + 1))});
        lines.remove_prefix(line.size() + 1);
    }
    return job;
}

std::string value_in(const Job& job, const std::string& name)
{
    const auto fact = std::ranges::find(job, name, &JobFact::name);
    return fact == job.end() ? "missing" : fact->value;
}

/// The first difference between two different jobs, as a clause.
std::string difference(const Job& before, const Job& now)
{
    for (const Job* const job : {&now, &before}) {
        for (const JobFact& fact : *job) {
            const std::string old_value = value_in(before, fact.name);
            const std::string new_value = value_in(now, fact.name);
            if (old_value == new_value) continue;
            return fmt::format("{} was {} and is now {}", fact.name, old_value, new_value);
        }
    }
    return "the order of the input files differs";
}

} // namespace

FileLock::~FileLock()
{
    if (file_ >= 0) ::close(file_);
}

WorkFolder::WorkFolder(fs::path folder) : folder_(std::move(folder))
{
    const bool is_made = make_folder(folder_);
    std::error_code error;
    const bool had_lock = fs::exists(folder_ / kLockName, error);
    lock_ = lock(folder_ / kLockName, true); // first, because nobody else changes a locked folder
    if (is_made) std::ofstream(folder_ / kLockName) << kMadeHere; // another process may lead
    if (!lock_) return;
    try {
        require_ours(folder_);
    } catch (...) {
        if (!had_lock) remove_quietly(folder_ / kLockName);
        throw;
    }
    if (fs::exists(folder_ / kEndedName, error))
        remove_stages(folder_); // of a run killed in clear()
}

WorkFolder::~WorkFolder()
{
    const bool has_ended = job_ != Digest{} && is_over();
    if (has_ended) try_lead(); // the process that led may have been killed in clear()
    if (leads() && (has_ended || !holds_stages())) clear();
    if (has_ended) remove_stages(folder_); // what this process added after the end
}

bool WorkFolder::try_lead()
{
    if (!leads()) lock_ = lock(folder_ / kLockName, false);
    return leads();
}

bool WorkFolder::is_over() const
{
    std::error_code error;
    return !fs::exists(folder_ / kJobName, error);
}

void WorkFolder::begin(const Job& job)
{
    const fs::path path = folder_ / kJobName;
    job_ = digest_of(job);
    while (!leads() && is_over() && !try_lead()) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    is_resumed_ = leads() && holds_stages();
    std::error_code error;         // a missing file is damaged
    if (leads() && !is_resumed_) { // nothing to resume or to lose
        write_job(job);
        began_ = fs::last_write_time(path, error);
        return;
    }
    began_ = fs::last_write_time(path, error);
    const std::string lines = job_lines(path, text_of(path));
    if (lines == job_text(job)) return;
    throw InputError(fmt::format("the work folder {} belongs to another run: {}; {}",
                                 folder_.string(), difference(parse_job(lines), job), kAnother));
}

void WorkFolder::write_job(const Job& job)
{
    OutputFile file(folder_ / kJobName);
    file.stream() << whole_text(std::string(kJobTitle) + job_text(job));
    file.commit();
}

fs::path WorkFolder::file_of(std::string_view stage) const
{
    return folder_ / fmt::format("{}{}", stage, kStageEnd);
}

bool WorkFolder::has(std::string_view stage) const
{
    std::error_code error;
    return fs::exists(file_of(stage), error);
}

FileLock WorkFolder::claim(std::string_view stage) const
{
    return lock(folder_ / fmt::format("{}{}", stage, kClaimEnd), true);
}

bool WorkFolder::holds_stages() const
{
    return std::ranges::any_of(files_in(folder_),
                               [](const fs::path& file) { return file.extension() == kStageEnd; });
}

void WorkFolder::drop_all(std::string_view begin) const
{
    remove_ours(folder_, [&](const std::string& name) { return name.starts_with(begin); });
}

void WorkFolder::clear()
{
    if (!leads()) return;
    std::error_code error;
    const bool was_made = text_of(folder_ / kLockName) == kMadeHere;
    const bool is_all_ours = std::ranges::all_of(
        files_in(folder_), [](const fs::path& file) { return is_ours(file.filename()); });
    fs::path folder = folder_;
    if (was_made && is_all_ours) { // ends for other processes at once
        folder += fmt::format(".ended-{}", ::getpid());
        fs::rename(folder_, folder, error);
        if (error) folder = folder_;
    }
    fs::rename(folder / kJobName, folder / kEndedName, error); // first, for is_over()
    remove_stages(folder);
    remove_quietly(folder / kEndedName);
    remove_quietly(folder / kLockName);
    if (was_made) remove_quietly(folder); // unless it has other files
    lock_ = {};                           // last, because freeing a removed file takes time
}

} // namespace vcarve
