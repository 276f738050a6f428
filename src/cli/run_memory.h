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

/// The properties of a run that must be the same on all ranks.
struct JobOfRanks {
    Digest job{};     ///< of the work folder
    Digest options{}; ///< see digest_of_options()
};

/// The ranks of a run, as its command uses them.
class RunRanks : public Ranks {
  public:
    /// Sends the job to the other ranks. Call it before work is shared.
    virtual void begin(const JobOfRanks& job) = 0;
};

/// A digest of the program and of the options that affect the surface.
Digest digest_of_options(const Options& options);

/// The folder of a run's scratch files: the work folder, or a temporary one.
class ArrayFolder {
  public:
    /// The folder of --work, or if that is empty, a folder beside the output.
    ArrayFolder(std::filesystem::path given, const std::filesystem::path& out);
    ArrayFolder(const ArrayFolder&) = delete;
    ArrayFolder& operator=(const ArrayFolder&) = delete;
    /// Removes a temporary folder.
    ~ArrayFolder();

    const std::filesystem::path& path() const { return path_; }
    bool is_temporary() const { return is_temporary_; }

    /// Creates the folder if it is missing. Throws UsageError if it cannot be created or written
    /// to, or has less free space than `bytes`.
    void prepare(std::int64_t bytes) const;

  private:
    bool is_temporary_;
    std::filesystem::path path_;
};

/// The memory limit in bytes: as given, or 80 % of the free memory. Nothing if unlimited.
std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted);

/// The options of a run in tiles: the memory limit applies to each of them.
Options options_of_tiles(const Options& given);

/// Decides whether a run works in memory or in blocks. In blocks, large arrays are in the work
/// folder while the object lives.
class RunMemory {
  public:
    RunMemory(const MemoryOptions& wanted, int threads, const ArrayFolder& folder);

    /// Plans for a size; called again when the size is known better. Later arrays are placed
    /// accordingly, and a note gives the number of blocks. Throws InputError if the memory is
    /// insufficient, and UsageError if the folder is.
    void fit(const RunSize& size, Log& log);

    /// The options for reconstruct().
    MemoryOptions options() const;
    /// {"blocks", "needed_bytes", "allowed_bytes", "expected_scratch_bytes", "scratch_bytes"}; the
    /// last is the peak.
    Json record() const;

  private:
    MemoryOptions wanted_;
    int threads_;
    const ArrayFolder& folder_;
    std::optional<std::int64_t> free_; ///< memory before the run allocates, in bytes
    BlockPlan plan_;
    std::optional<ScratchMemory> scratch_;
};

} // namespace vcarve::cli
