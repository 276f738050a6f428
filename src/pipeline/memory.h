#pragma once

#include "pipeline/stage_memory.h"
#include "steps/3_cells/limits.h"
#include "vcarve/options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The expected peak memory of the process during a stage of the pipeline.
struct StageMemory {
    const char* stage; ///< name in the log
    std::int64_t bytes;
};

/// Predicts the memory of each stage (stages.h) from the sizes of the arrays that are alive at the
/// same time (stage_memory.cpp), for the usual number of cells per point (Sizes::cells_of_point).
/// Points in rare positions, such as on two curves, can have many more cells and need more memory.
std::vector<StageMemory> predicted_memory(const RunSize& size, int threads);

/// The maximum over all stages, in bytes.
std::int64_t predicted_peak(const RunSize& size, int threads);

/// The size of a run before its scene is thinned. A dense scene counts as empty after thinning.
RunSize size_before_thinning(const SceneSize& read, const Options& options);

/// Bounds of the ratio of predicted to measured peak. On sample models it is 1.04 (a million points
/// on two threads) to 1.34 (30 thousand points on one). A test checks these bounds, and tools/bench
/// warns if a run is outside.
inline constexpr double kLeastPredicted = 1.0;
inline constexpr double kMostPredicted = 1.4;

/// Throws InputError with both sizes if the prediction exceeds `most` bytes; <= 0 disables it.
void require_memory(const RunSize& size, int threads, std::int64_t most);

/// The same with the limit of the run's options. Does nothing for a run in blocks.
void require_memory_of(const RunSize& size, int threads);

/// The maximum number of cells for the run's memory limit: of all cells in memory, or of the cells
/// of the current blocks. Never less than points usually have.
CellLimit limit_of_cells(const RunSize& size, int threads);

/// How a run stays within its memory limit.
struct BlockPlan {
    int blocks = 0;           ///< number of blocks; 0 runs in memory
    std::int64_t needed = 0;  ///< predicted bytes of a run in memory
    std::int64_t limit = 0;   ///< allowed bytes; 0 disables the limit
    std::int64_t scratch = 0; ///< maximum bytes of arrays in the work folder; 0 in memory

    /// Whether the run is in blocks, with large arrays in the work folder.
    bool in_blocks() const { return blocks > 0; }
};

/// Plans a run in memory if the options demand it or the run fits; otherwise in blocks. Blocks are
/// triangulated at the same time, one per thread, and get half of the memory. `free` is the
/// system's free memory, or nullopt if unknown; without a limit in the options, 4/5 of it is
/// allowed. Throws InputError if a run in memory would exceed the options' limit, or if the memory
/// that each point needs even in blocks exceeds the allowed memory.
BlockPlan plan_blocks(const RunSize& size, int threads, const MemoryOptions& wanted,
                      std::optional<std::int64_t> free);

/// The least memory that a run in blocks needs, in bytes.
std::int64_t least_memory(const RunSize& size, int threads);

/// The peak size of arrays in the work folder, in bytes.
std::int64_t predicted_scratch(const RunSize& size);

} // namespace vcarve
