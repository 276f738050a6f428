#pragma once

#include "base/scratch_memory.h"
#include "cli/run_record.h"
#include "pipeline/memory.h"
#include "run/digest.h"
#include "run/ranks.h"
#include "vcarve/options.h"

#include <cstddef>
#include <filesystem>
#include <optional>

namespace vcarve::cli {

/// How many processes work on a run.
struct Processes {
    std::size_t all = 1;
    std::size_t here = 1; ///< on this machine
};

/// What ranks have to agree on.
struct JobOfRanks {
    Digest job{};          ///< of the work folder
    Digest options{};      ///< see digest_of_options()
    bool in_files = false; ///< large arrays are in the work folder
};

/// The other processes of a run, as its command knows them.
class RunRanks : public Ranks {
  public:
    virtual Processes processes() const = 0;
    std::size_t count() const override { return processes().all; }

    /// Tells the others, before anything is shared, what run it is.
    virtual void begin(const JobOfRanks& job) = 0;
};

/// Differs where options, or programs, make other surfaces.
Digest digest_of_options(const Options& options);

/// The folder that the scratch files of a run are in: the work folder, or one for the run alone.
class ArrayFolder {
  public:
    /// What --work says, or where that is empty, a folder beside the output.
    ArrayFolder(std::filesystem::path given, const std::filesystem::path& out);
    ArrayFolder(const ArrayFolder&) = delete;
    ArrayFolder& operator=(const ArrayFolder&) = delete;
    /// Removes a temporary one.
    ~ArrayFolder();

    const std::filesystem::path& path() const { return path_; }
    /// Whether it is there for this run alone, which is to remove it.
    bool is_temporary() const { return is_temporary_; }

    /// Makes it, where it is not there. Throws UsageError where that cannot be, and where it cannot
    /// be written to or has less than so many bytes free.
    void prepare(std::int64_t bytes) const;

  private:
    bool is_temporary_;
    std::filesystem::path path_;
};

/// How much one of some processes on this machine may take, in bytes, as --max-memory says: given,
/// or four fifths of its share of what is free now; nothing where there is no limit.
std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted, std::size_t processes);

/// Decides whether a run works in memory or in blocks, and keeps its arrays in the work folder in
/// the latter case, for as long as the object lives.
class RunMemory {
  public:
    /// Several processes on a machine share what it has free, and cut the model into blocks, of
    /// which each of them has some; where each could have all of the run in memory, arrays stay
    /// there.
    RunMemory(const MemoryOptions& wanted, int threads, const ArrayFolder& folder,
              const Processes& processes = {});

    /// Once the size of a run is known, and again when more is known of it: arrays that are made
    /// from now on are where they should be. A note says how many blocks there are and why. Throws
    /// InputError where the memory does not do, UsageError where the folder does not.
    void fit(const RunSize& size, Log& log);

    /// What reconstruct() is to be told.
    MemoryOptions options() const;
    /// Whether large arrays are in the work folder.
    bool in_files() const { return plan_.in_files(); }
    /// {"blocks", "needed_bytes", "allowed_bytes", "expected_scratch_bytes", "scratch_bytes"}; the
    /// last is the most that was in the folder at a time up to now.
    Json record() const;

  private:
    BlockPlan plan_of(const RunSize& size) const;

    MemoryOptions wanted_;
    int threads_;
    const ArrayFolder& folder_;
    Processes processes_;
    std::optional<std::int64_t> free_; ///< before the run took any, for each process
    BlockPlan plan_;
    std::optional<ScratchMemory> scratch_;
};

} // namespace vcarve::cli
