#pragma once

#include "run/job.h"
#include "run/stage_file.h"
#include "vcarve/log.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vcarve {

/// A part of a stage that several threads save in parts.
struct StagePiece {
    std::string_view stage;
    std::size_t number; ///< from 0
    std::size_t of;     ///< number of parts; other numbers mean different parts
};

/// A folder with checkpoints of one job, so that a run that was stopped can be resumed. It has one
/// file per finished stage, one that records the job, and one that the process locks, also against
/// other objects in the same process. The system releases the lock when the process ends, even if
/// it is killed.
class WorkFolder {
  public:
    /// Creates the folder if it is missing, and locks it. Removes incomplete files of killed runs.
    /// Throws UsageError if the folder cannot be created or written, or has other files but no job.
    /// Throws InputError if another run uses it.
    explicit WorkFolder(std::filesystem::path folder);
    /// Joins the folder of another process, which locked it and began `job`. Stages can be read and
    /// parts of them written, as the two processes agree.
    WorkFolder(std::filesystem::path folder, const Digest& job);
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    /// Unlocks the folder. Clears it if it has no stages for a later run to resume.
    ~WorkFolder();

    /// Sets the job; call it once, before the other functions. Throws InputError if the folder has
    /// stages of another job, with the first difference, or if the job's file is damaged. The
    /// folder is unchanged then.
    void begin(const Job& job);

    const std::filesystem::path& path() const { return folder_; }
    const Digest& job() const { return job_; }
    /// Whether the folder had stages of an earlier run when the job began.
    bool is_resumed() const { return is_resumed_; }
    bool has(std::string_view stage) const;
    /// Marks a stage as being made by the caller. Returns false if another process of the run did
    /// so before. Marks of earlier runs do not count.
    bool claim(std::string_view stage) const;
    /// Waits for a stage that another process has written, because network file systems show new
    /// files to other machines late. Throws UsageError if the stage is missing after a minute, or
    /// the folder after 5 seconds, and Cancelled.
    void wait_for(std::string_view stage, const Progress& progress = {}) const;

    /// Writes the result of a stage, and returns its size in bytes. Throws UsageError if it cannot
    /// be written, and Cancelled; the file is complete or missing. Thread-safe for different
    /// stages.
    template <typename... Parts>
    std::uint64_t save(std::string_view stage, const Progress& progress,
                       const Parts&... parts) const;
    /// Reads the result of a stage in the order of save(), and returns its size in bytes. Throws
    /// InputError if the file is not as save() wrote it; parts may then be incomplete. Thread-safe.
    template <typename... Parts>
    std::uint64_t load(std::string_view stage, const Progress& progress, Parts&... parts) const;

    /// Removes a stage if it exists.
    void drop(std::string_view stage) const;
    /// Removes all stages whose names begin so.
    void drop_all(std::string_view begin) const;

    /// Removes all files of the run, and the folder if WorkFolder created it and it is then empty.
    /// Does nothing in a joined folder. Call it last.
    void clear();

  private:
    std::filesystem::path file_of(std::string_view stage) const;
    bool holds_stages() const;
    void write_job(const Job& job);

    std::filesystem::path folder_;
    bool is_resumed_ = false;
    bool was_made_ = false; ///< whether this object or a killed run created the folder
    int lock_ = -1;         ///< descriptor of the lock file; -1 if joined
    Digest job_{};          ///< set by begin()
};

/// The name of a part of a stage, such as "cells-3-of-8".
std::string piece_name(const StagePiece& piece);

template <typename... Parts>
std::uint64_t WorkFolder::save(std::string_view stage, const Progress& progress,
                               const Parts&... parts) const
{
    StageWriter counter;
    (counter.put(parts), ...);
    StageWriter writer(file_of(stage), {std::string(stage), job_}, counter.bytes(), progress);
    (writer.put(parts), ...);
    writer.commit();
    return writer.bytes();
}

template <typename... Parts>
std::uint64_t WorkFolder::load(std::string_view stage, const Progress& progress,
                               Parts&... parts) const
{
    StageReader reader(file_of(stage), {std::string(stage), job_}, progress);
    (reader.get(parts), ...);
    reader.finish();
    return reader.bytes();
}

} // namespace vcarve
