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

/// A digest of the program and of the options that affect the surface.
Digest digest_of_options(const Options& options);

/// The folder of a run's scratch files: the work folder, or a temporary one.
class ArrayFolder {
  public:
    /// The folder of --work, or if that is empty, a folder beside the output.
    ArrayFolder(std::filesystem::path given, const std::filesystem::path& out);
    ArrayFolder(const ArrayFolder&) = delete;
    ArrayFolder& operator=(const ArrayFolder&) = delete;
    /// Removes a temporary one.
    ~ArrayFolder();

    const std::filesystem::path& path() const { return path_; }
    bool is_temporary() const { return is_temporary_; }

    /// Makes it, if missing. Throws UsageError if it cannot be made or written to, or has fewer
    /// bytes free.
    void prepare(std::int64_t bytes) const;

  private:
    bool is_temporary_;
    std::filesystem::path path_;
};

/// The memory limit of one of several processes on this machine, in bytes: as given, or 80 % of its
/// share of the free memory; nothing for no limit.
std::optional<std::int64_t> allowed_memory(const MemoryOptions& wanted, std::size_t processes);

/// Decides whether a run works in memory or in blocks, and keeps its arrays in the work folder in
/// the latter case, for as long as the object lives.
class RunMemory {
  public:
    /// Processes on a machine share its free memory and the blocks of the model. Arrays stay in
    /// memory if each process could hold the whole run.
    RunMemory(const MemoryOptions& wanted, int threads, const ArrayFolder& folder,
              const Processes& processes = {});

    /// Plans for a size; called again when more is known. Later arrays are placed accordingly, and
    /// a note tells the number of blocks. Throws InputError if the memory, UsageError if the folder
    /// does not suffice.
    void fit(const RunSize& size, Log& log);

    /// The options for reconstruct().
    MemoryOptions options() const;
    /// Whether large arrays are in the work folder.
    bool in_files() const { return plan_.in_files(); }
    /// {"blocks", "needed_bytes", "allowed_bytes", "expected_scratch_bytes", "scratch_bytes"}; the
    /// last is the peak.
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
