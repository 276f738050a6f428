#pragma once

#include "pipeline/run_state.h"
#include "run/ranks.h"
#include "steps/3_cells/limits.h"
#include "steps/4_visibility/trace.h"
#include "vcarve/log.h"
#include "vcarve/options.h"

#include <cstddef>
#include <optional>
#include <string_view>

// The work that ranks share: the blocks of the triangulation, and the rays. Each rank follows the
// rays of a range of points through all cells. The sums are integers, so they equal those of a
// single rank.

namespace vcarve {

/// Prefixes of task names: blocks to triangulate, and rays to follow.
inline constexpr std::string_view kBlocksTask = "task-blocks";
inline constexpr std::string_view kRaysTask = "task-rays";

/// The task of triangulating blocks; its other input is the points.
struct BlocksTask {
    std::size_t count = 0; ///< number of all blocks
    CellLimit limit{};
};

/// Makes the same cells as triangulate() in blocks, on all ranks. Saves each block separately.
/// Returns nullopt if triangulate_in_blocks() gives up.
std::optional<TetMesh> triangulate_by_ranks(const BlocksTask& blocks, RunState& run,
                                            const Progress& progress);

/// The energy of the photographs' rays, which all ranks follow. This rank follows the rays of
/// shares that are missing or unreadable.
VisibilityEnergy walk_by_ranks(RunState& run, const Progress& progress);

/// The points whose rays a rank follows. Ranks get equal numbers of rays, up to those of one point.
VertexRun share_of(const Tracks& rays, const Rank& rank);

/// Does a rank's shares of a run, as rank 0 orders. Memory: 20 bytes per cell, the scene and the
/// cells. Scene and cells are mapped from the work folder if a ScratchMemory exists, else read.
class RankShares {
  public:
    /// `folder` must be joined. `options` are those of the run. Both must outlive the object.
    RankShares(WorkFolder& folder, const Options& options, const Rank& rank)
        : folder_(folder), options_(options), rank_(rank)
    {
    }

    /// Does this rank's share of a task, and saves its results in the folder. Throws InputError if
    /// files cannot be read, UsageError if they cannot be written, and Cancelled.
    void work(std::string_view task, Log& log);

  private:
    void triangulate(std::string_view file, Log& log);
    void walk_rays(std::string_view file, Log& log);
    const Scene& scene();
    const TetMesh& cells();

    WorkFolder& folder_;
    const Options& options_;
    Rank rank_;
    std::optional<CarvingPoints> points_;
    std::optional<TetMesh> cells_;
};

} // namespace vcarve
