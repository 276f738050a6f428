#pragma once

#include "model/scene_size.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// The most memory a process is expected to hold while a stage of the pipeline runs.
struct StageMemory {
    const char* stage; ///< as the log calls it
    std::int64_t bytes;
};

/// What a run will need, stage by stage, by the size of what it reads. Made of the sizes of the
/// arrays that are alive at once (pipeline_memory.cpp says which), for the method `cut`, which of
/// all needs most, and for points as they usually are: 6.8 cells a point, where points at random
/// in space have 6.77 and points near a surface about 6. Held against runs by tools/bench: on
/// sample models from 10 thousand to a million points it is 10 to 40 % above what was needed.
/// Points in rare positions (on two curves, say) can have many more cells, and need more.
std::vector<StageMemory> predicted_memory(const SceneSize& size, int threads);

/// The most of these, in bytes.
std::int64_t predicted_peak(const SceneSize& size, int threads);

/// Throws InputError where the prediction is above `most` bytes, naming both; 0 allows all.
void require_memory(const SceneSize& size, int threads, std::int64_t most);

} // namespace vcarve
