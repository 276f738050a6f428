#pragma once

#include "model/scene_size.h"
#include "vcarve/options.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// The most memory a process is expected to hold while a stage of the pipeline runs.
struct StageMemory {
    const char* stage; ///< as the log calls it
    std::int64_t bytes;
};

/// How much a run reads, and how much of it is left when the points of a cloud are merged.
struct RunSize {
    SceneSize read;
    SceneSize thinned;
    bool in_parts = false; ///< points are merged while they are read, and never all in memory
};

/// What a run will need, stage by stage. Made of the sizes of the arrays that are alive at once
/// (memory.cpp says which), for the method `cut`, which of all needs most, and for points as they
/// usually are: 6.8 cells a point, where points at random in space have 6.77 and points near a
/// surface about 6. Points in rare positions (on two curves, say) can have many more cells, and
/// need more.
std::vector<StageMemory> predicted_memory(const RunSize& size, int threads);

/// The most of these, in bytes.
std::int64_t predicted_peak(const RunSize& size, int threads);

/// What is known before a scene is thinned: of a dense one, nothing for certain is left.
RunSize size_before_thinning(const SceneSize& read, const ThinOptions& options);

/// The predicted peak over the one measured lies between these: 1.04 (a million points on two
/// threads) to 1.34 (30 thousand on one) on sample models. A test holds the program to it, and
/// tools/bench warns where a run is not in between.
inline constexpr double kLeastPredicted = 1.0;
inline constexpr double kMostPredicted = 1.4;

/// Throws InputError where the prediction is above `most` bytes, naming both; 0 allows all.
void require_memory(const RunSize& size, int threads, std::int64_t most);

} // namespace vcarve
