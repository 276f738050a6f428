#pragma once

#include "run/job.h"
#include "run/stage_file.h"
#include "vcarve/log.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace vcarve {

/// An exclusive lock on a file, which the system releases when the process ends, even if it is
/// killed. It also excludes other objects in the same process. Across machines, the file system
/// must support flock(2).
class FileLock {
  public:
    FileLock() = default;
    /// Takes over an open and locked file.
    explicit FileLock(int file) : file_(file) {}
    FileLock(FileLock&& other) noexcept : file_(std::exchange(other.file_, -1)) {}
    FileLock& operator=(FileLock&& other) noexcept
    {
        std::swap(file_, other.file_);
        return *this;
    }
    ~FileLock();

    explicit operator bool() const { return file_ >= 0; }

  private:
    int file_ = -1;
};

/// A folder with finished stages of one job, so that a run that was stopped can be resumed, and
/// several processes can share its work. It has one file per stage, one that records the job, and
/// one that the process which leads the run locks. If that process ends, another can lead.
class WorkFolder {
  public:
    /// Creates the folder if it is missing, and leads it unless another process does. Throws
    /// UsageError if the folder cannot be created or written, or has other files but no job.
    explicit WorkFolder(std::filesystem::path folder);
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    /// Clears the folder if this process leads it and it has no stages for a later run to resume.
    ~WorkFolder();

    /// Sets the job; call it once, before the other functions. Waits for the process that leads to
    /// do so first. Throws InputError if the folder has stages of another job, with the first
    /// difference, or if the job's file is damaged. The folder is unchanged then.
    void begin(const Job& job);

    bool leads() const { return static_cast<bool>(lock_); }
    /// Leads the folder if no other process does.
    bool try_lead();
    /// Whether the process that led has cleared the folder.
    bool is_over() const;

    const std::filesystem::path& path() const { return folder_; }
    /// The time when the job began, also if other processes began it.
    std::filesystem::file_time_type began() const { return began_; }
    /// Whether the folder had stages of an earlier run when the job began.
    bool is_resumed() const { return is_resumed_; }
    bool has(std::string_view stage) const;
    /// The right to make a stage, as long as the result lives; nothing if another process has it.
    FileLock claim(std::string_view stage) const;

    /// Writes the result of a stage. Throws UsageError if it cannot be written; the file is
    /// complete or missing. Thread-safe for different stages.
    template <typename... Parts>
    void save(std::string_view stage, const Parts&... parts) const;
    /// Reads the result of a stage in the order of save(). Throws InputError if the file is not as
    /// save() wrote it; parts may then be incomplete. Thread-safe.
    template <typename... Parts>
    void load(std::string_view stage, Parts&... parts) const;

    /// Removes all stages whose names begin so.
    void drop_all(std::string_view begin) const;

    /// Removes all files of the run, and the folder if WorkFolder created it and it is then empty.
    /// Does nothing if another process leads. Call it last.
    void clear();

  private:
    std::filesystem::path file_of(std::string_view stage) const;
    bool holds_stages() const;
    void write_job(const Job& job);

    std::filesystem::path folder_;
    bool is_resumed_ = false;
    std::filesystem::file_time_type began_;
    FileLock lock_; ///< held if this process leads
    Digest job_{};  ///< set by begin()
};

template <typename... Parts>
void WorkFolder::save(std::string_view stage, const Parts&... parts) const
{
    StageWriter counter;
    (counter.put(parts), ...);
    StageWriter writer(file_of(stage), {std::string(stage), job_}, counter.bytes());
    (writer.put(parts), ...);
    writer.commit();
}

template <typename... Parts>
void WorkFolder::load(std::string_view stage, Parts&... parts) const
{
    StageReader reader(file_of(stage), {std::string(stage), job_});
    (reader.get(parts), ...);
    reader.finish();
}

} // namespace vcarve
