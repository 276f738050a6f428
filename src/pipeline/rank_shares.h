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

// What the ranks of a run share: the blocks of the triangulation, and the lines of sight, of which
// each walks those to a run of points, through all cells. What these say are integers, so their
// sums are what one rank alone would get.

namespace vcarve {

/// What the names of tasks for ranks begin with: blocks to triangulate, and sights to walk.
inline constexpr std::string_view kBlocksTask = "task-blocks";
inline constexpr std::string_view kSightsTask = "task-sights";

/// What is to be known of blocks, beside the points.
struct BlocksTask {
    std::size_t count = 0; ///< of all blocks
    CellLimit limit{};
};

/// The same cells as triangulate(), made in so many blocks, each of which is kept by itself, by all
/// ranks. Nothing where triangulate_in_blocks() gives up.
std::optional<TetMesh> triangulate_by_ranks(const BlocksTask& blocks, RunState& run,
                                            const Progress& progress);

/// What the sights of the photographs say of the cells, walked by all ranks. A share that is
/// missing, or cannot be read, is walked by this one.
VisibilityEnergy walk_by_ranks(RunState& run, const Progress& progress);

/// The points whose rays a rank walks: as many rays as any other, but for those of a point.
VertexRun share_of(const Tracks& rays, const Rank& rank);

/// Does a rank's shares of a run, as the first rank asks for them. Memory: the scene and the cells,
/// mapped from the work folder where there is a ScratchMemory, else read; and 20 bytes a cell.
class RankShares {
  public:
    /// `folder` is joined; `options` are those of the run. Both must outlive it.
    RankShares(WorkFolder& folder, const Options& options, const Rank& rank)
        : folder_(folder), options_(options), rank_(rank)
    {
    }

    /// Does this rank's share of the task of that name: its results are in the folder then. Throws
    /// InputError and UsageError where files cannot be read or written, and Cancelled.
    void work(std::string_view task, Log& log);

  private:
    void triangulate(std::string_view file, Log& log);
    void walk_sights(std::string_view file, Log& log);
    const Scene& scene();
    const TetMesh& cells();

    WorkFolder& folder_;
    const Options& options_;
    Rank rank_;
    std::optional<CarvingPoints> points_;
    std::optional<TetMesh> cells_;
};

} // namespace vcarve
