#pragma once

#include "pipeline/stage_memory.h"
#include "steps/3_cells/limits.h"
#include "vcarve/options.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The most memory a process is expected to hold while a stage of the pipeline runs.
struct StageMemory {
    const char* stage; ///< as the log calls it
    std::int64_t bytes;
};

/// What a run will need, stage by stage (stages.h). Made of the sizes of the arrays that are alive
/// at once (stage_memory.cpp says which), for points as they usually are (Sizes::cells). Points in
/// rare positions (on two curves, say) can have many more cells, and need more.
std::vector<StageMemory> predicted_memory(const RunSize& size, int threads);

/// The most of these, in bytes.
std::int64_t predicted_peak(const RunSize& size, int threads);

/// What is known before a scene is thinned: of a dense one, nothing for certain is left.
RunSize size_before_thinning(const SceneSize& read, const Options& options);

/// The predicted peak over the one measured lies between these: 1.04 (a million points on two
/// threads) to 1.34 (30 thousand on one) on sample models. A test holds the program to it, and
/// tools/bench warns where a run is not in between.
inline constexpr double kLeastPredicted = 1.0;
inline constexpr double kMostPredicted = 1.4;

/// Throws InputError where the prediction is above `most` bytes, naming both; 0 or less allows all.
void require_memory(const RunSize& size, int threads, std::int64_t most);

/// The same as the options of the run say; blocks that are asked for are not looked at.
void require_memory_of(const RunSize& size, int threads);

/// How many cells a run may make, for its memory to do: in memory all of them, in blocks those of
/// the blocks in work. Never less than points usually have.
CellLimit limit_of_cells(const RunSize& size, int threads);

/// How a run gets by with the memory it may take.
struct BlockPlan {
    int blocks = 0;           ///< 0: it works in memory
    std::int64_t needed = 0;  ///< in memory, as predicted
    std::int64_t most = 0;    ///< how much it may take; 0 for all
    std::int64_t scratch = 0; ///< the most that arrays in the work folder will take; 0 in memory

    bool in_blocks() const { return blocks > 0; }
    /// Whether arrays are in the work folder.
    bool in_files() const { return scratch > 0; }
};

/// In memory where the options ask for that, or the run fits; else in blocks, so many that those
/// being triangulated at a time, one a thread, take half of what is allowed. `free` is what the
/// system has, of which four fifths are allowed where the options leave that open; nothing where it
/// is not known. Throws InputError where a run in memory would need more than the options say, or
/// one in blocks more than is allowed: each point needs some memory even then.
BlockPlan plan_blocks(const RunSize& size, int threads, const MemoryOptions& wanted,
                      std::optional<std::int64_t> free);

/// The least memory that a run in blocks needs, in bytes.
std::int64_t least_memory(const RunSize& size, int threads);

/// The most that arrays in the work folder take at a time, in bytes.
std::int64_t predicted_scratch(const RunSize& size);

/// The most that arrays of another rank take there, in bytes: what the sights say that it walks.
std::int64_t predicted_share(const RunSize& size);

} // namespace vcarve
