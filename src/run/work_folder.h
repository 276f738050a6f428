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

/// A part of a stage that is kept in parts, by threads of their own.
struct StagePiece {
    std::string_view stage;
    std::size_t number; ///< from 0
    std::size_t of;     ///< how many there are; parts of another number are others
};

/// A folder with what the finished stages of one job made, so that a run which ended too early can
/// be gone on with: a file a stage, one that says what the job is, and one that is locked by the
/// process that works there, also against other objects of the same process. The system takes the
/// lock away when the process ends, however it ends.
class WorkFolder {
  public:
    /// Makes the folder where there is none, and locks it. Throws UsageError where it cannot be
    /// made or written, or holds something but is no work folder; InputError where another run
    /// works in it. What a killed run left half written is removed.
    explicit WorkFolder(std::filesystem::path folder);
    /// Another process's folder, which it has locked and begun a job in: stages may be read and
    /// parts of them written, as the two agree.
    WorkFolder(std::filesystem::path folder, const Digest& job);
    WorkFolder(const WorkFolder&) = delete;
    WorkFolder& operator=(const WorkFolder&) = delete;
    /// Unlocks it. It goes where it holds nothing that a later run could go on with.
    ~WorkFolder();

    /// Says whose stages these are; call it once, before the rest. Throws InputError where the
    /// folder holds stages of another job, naming the first thing that differs, or where what it
    /// says of its job is damaged; nothing is changed then.
    void begin(const Job& job);

    const std::filesystem::path& path() const { return folder_; }
    const Digest& job() const { return job_; }
    /// Whether there were stages of an earlier run when the job began.
    bool goes_on() const { return goes_on_; }
    bool has(std::string_view stage) const;
    /// Returns when a stage is there that another process has written: network file systems show
    /// new files to other machines late. Throws UsageError where it is not within a minute, or the
    /// folder within 5 seconds, and Cancelled.
    void wait_for(std::string_view stage, const Progress& progress = {}) const;

    /// Writes what a stage made; tells how many bytes it were. Throws UsageError where that cannot
    /// be written, and Cancelled; the file is whole or not there. Safe from many threads for
    /// different stages.
    template <typename... Parts>
    std::uint64_t save(std::string_view stage, const Progress& progress,
                       const Parts&... parts) const;
    /// Reads it, in the order it was written; tells how many bytes it were. Throws InputError where
    /// the file is not as save() left it; the parts may be half read then. Safe from many threads.
    template <typename... Parts>
    std::uint64_t load(std::string_view stage, const Progress& progress, Parts&... parts) const;

    /// The same without a look at whether the content is what was written, for stages that this
    /// run wrote or has loaded: large arrays that are in scratch memory are mapped from the file,
    /// to be read only.
    template <typename... Parts>
    void map(std::string_view stage, Parts&... parts) const;

    /// Removes a stage, if it is there.
    void drop(std::string_view stage) const;
    /// Removes the parts of a stage, whatever their number.
    void drop_pieces(std::string_view stage) const;

    /// Removes what the run kept, and the folder where it was made by WorkFolder and holds nothing
    /// else. Call it last.
    void clear();

  private:
    std::filesystem::path file_of(std::string_view stage) const;
    bool holds_stages() const;
    void write_job(const Job& job);

    std::filesystem::path folder_;
    bool goes_on_ = false;
    bool was_made_ = false; ///< by this object, or by a run that was killed
    int lock_ = -1;         ///< descriptor
    Digest job_{};          ///< set by begin()
};

/// The name under which a part of a stage is saved: "cells-3-of-8".
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

template <typename... Parts>
void WorkFolder::map(std::string_view stage, Parts&... parts) const
{
    StageReader reader(file_of(stage), {std::string(stage), job_}, {},
                       StageReader::Content::mapped);
    (reader.get(parts), ...);
    reader.finish();
}

} // namespace vcarve
