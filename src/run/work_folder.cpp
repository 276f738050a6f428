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
constexpr const char* kStageEnd = ".stage";
constexpr const char* kClaimEnd = ".claim";
/// The first line of the job's file. kJobEnd begins its last line.
constexpr std::string_view kJobTitle = "work folder of colmap-vcarve, layout 1\n";
/// Content of the lock file, which is removed last, if the folder must be removed, too.
constexpr std::string_view kMadeHere = "the folder was made by the run\n";
constexpr std::string_view kJobEnd = "digest of the lines above\t";
constexpr const char* kAnother = "choose another folder with --work, or remove this one to start "
                                 "over";

/// Whether a file name is that of an incomplete file, see part_path().
bool is_part(const std::string& name)
{
    return name.find(".part-") != std::string::npos;
}

/// Whether a file name is that of a claim, which ends with its run.
bool is_claim(const std::string& name)
{
    return name.ends_with(kClaimEnd);
}

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
    if (fs::exists(folder / kJobName, error)) return;
    for (const fs::path& file : files_in(folder)) {
        const std::string name = file.filename();
        if (name == kLockName || (is_ours(name) && is_part(name))) continue;
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

/// Locks the folder and returns the descriptor of the lock file. A run that ends removes this file,
/// so a file that was opened just before may no longer be in the folder.
int lock(const fs::path& folder)
{
    const fs::path path = folder / kLockName;
    for (;;) {
        const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
        if (file < 0) {
            throw UsageError(fmt::format("cannot write to the work folder {}: {}", folder.string(),
                                         std::strerror(errno)));
        }
        if (::flock(file, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            ::close(file);
            if (error == EWOULDBLOCK) {
                throw InputError(fmt::format("another run uses the work folder {}; wait until it "
                                             "ends, or choose another folder with --work",
                                             folder.string()));
            }
            throw UsageError(fmt::format("cannot lock the work folder {}: {}", folder.string(),
                                         std::strerror(error)));
        }
        if (is_same_file(file, path)) return file;
        ::close(file);
    }
}

void remove_quietly(const fs::path& path)
{
    std::error_code error; // a file that cannot be removed stays
    fs::remove(path, error);
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

WorkFolder::WorkFolder(fs::path folder)
    : folder_(std::move(folder)), was_made_(make_folder(folder_))
{
    std::error_code error;
    const bool had_lock = fs::exists(folder_ / kLockName, error);
    lock_ = lock(folder_); // first, because nobody else changes a locked folder
    try {
        require_ours(folder_);
    } catch (...) {
        if (!had_lock) remove_quietly(folder_ / kLockName);
        ::close(lock_);
        throw;
    }
    if (was_made_) {
        std::ofstream(folder_ / kLockName) << kMadeHere;
    } else {
        was_made_ = text_of(folder_ / kLockName) == kMadeHere;
    }
    for (const fs::path& file : files_in(folder_)) {
        const std::string name = file.filename();
        if (is_ours(name) && (is_part(name) || is_claim(name))) remove_quietly(file);
    }
}

WorkFolder::WorkFolder(fs::path folder, const Digest& job) : folder_(std::move(folder)), job_(job)
{
}

WorkFolder::~WorkFolder()
{
    if (lock_ < 0) return;
    if (!holds_stages()) {
        clear();
    } else {
        ::close(lock_);
    }
}

void WorkFolder::begin(const Job& job)
{
    const fs::path path = folder_ / kJobName;
    job_ = digest_of(job);
    is_resumed_ = holds_stages();
    if (!is_resumed_) { // nothing to resume or to lose
        write_job(job);
        return;
    }
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

bool WorkFolder::claim(std::string_view stage) const
{
    const fs::path path = folder_ / fmt::format("{}{}", stage, kClaimEnd);
    const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file >= 0) ::close(file);
    if (file < 0 && errno != EEXIST) {
        throw UsageError(fmt::format("cannot write to the work folder {}: {}", folder_.string(),
                                     std::strerror(errno)));
    }
    return file >= 0;
}

void WorkFolder::wait_for(std::string_view stage, const Progress& progress) const
{
    // Network file systems may report a new file as missing for half a minute.
    const auto begin = std::chrono::steady_clock::now();
    while (!has(stage)) {
        std::error_code error;
        const std::chrono::seconds most(fs::exists(folder_, error) ? 60 : 5);
        progress.report(0.0);
        if (std::chrono::steady_clock::now() > begin + most) {
            throw UsageError(fmt::format("{} is missing; --work needs a folder on a file system "
                                         "that all ranks see",
                                         file_of(stage).string()));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
}

bool WorkFolder::holds_stages() const
{
    return std::ranges::any_of(files_in(folder_),
                               [](const fs::path& file) { return file.extension() == kStageEnd; });
}

void WorkFolder::drop(std::string_view stage) const
{
    remove_quietly(file_of(stage));
}

void WorkFolder::drop_all(std::string_view begin) const
{
    for (const fs::path& file : files_in(folder_)) {
        const std::string name = file.filename();
        if (name.starts_with(begin) && is_ours(name)) remove_quietly(file);
    }
}

void WorkFolder::clear()
{
    if (lock_ < 0) return;
    // The job is removed after its stages, so that a run killed in between leaves a work folder.
    for (const fs::path& file : files_in(folder_)) {
        const std::string name = file.filename();
        if (is_ours(name) && name != kJobName && name != kLockName) remove_quietly(file);
    }
    remove_quietly(folder_ / kJobName);
    remove_quietly(folder_ / kLockName);
    if (was_made_) remove_quietly(folder_); // unless it has other files
    ::close(std::exchange(lock_, -1));      // last, because freeing a removed file takes time
}

std::string piece_name(const StagePiece& piece)
{
    return fmt::format("{}-{}-of-{}", piece.stage, piece.number, piece.of);
}

} // namespace vcarve
