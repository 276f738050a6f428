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
    bool is_stereo = false; ///< a stage of Part::dense
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

/// The maximum number of cells for the run's memory limit, never less than points usually have.
std::size_t most_cells(const RunSize& size, int threads);

} // namespace vcarve
