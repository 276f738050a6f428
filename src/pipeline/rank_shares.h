#pragma once

#include "io/work/kept_fields.h"
#include "io/work/ranks.h"
#include "io/work/stage_keeper.h"
#include "steps/3_cells/triangulate_blocks.h"
#include "vcarve/log.h"
#include "vcarve/options.h"

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

// What the ranks of a run do beside the first, which runs reconstruct.cpp. (The lines of sight are
// in steps/4_visibility/shared_sights.h.)

namespace vcarve {

/// Blocks that ranks are to triangulate, what the name of such a task begins with, and the stages
/// that it takes.
struct BlocksTask {
    std::size_t count = 0; ///< of all blocks
};
inline constexpr std::string_view kBlocksTask = "task-blocks";
inline constexpr std::array<std::string_view, 1> kNeededForBlocks = {"points"};

/// Blocks that are parts of the stage "cells".
Blocks kept_blocks(std::size_t count, StageKeeper& work);

/// Blocks that all ranks make, as the first of them sees it: it holds its own in memory where all
/// of these are in work at a time, for then a run that is killed leaves none of them to the next.
class SharedBlocks {
  public:
    /// `work` must outlive it.
    SharedBlocks(std::size_t count, StageKeeper& work);

    Blocks own();
    /// All of them, once; to be asked for when the ranks have made them.
    Blocks all();

  private:
    StageKeeper& work_;
    std::vector<std::optional<BlockCells>> held_;
};

/// Does a rank's shares of a run, as the first rank asks for them. Memory: the scene and the cells,
/// mapped from the work folder where there is a ScratchMemory, else read; and 20 bytes a cell, 16
/// with Method::strict.
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
    void triangulate(std::string_view task, Log& log);
    void walk_sights(std::string_view task, Log& log);
    const Scene& scene();
    const TetMesh& cells();

    WorkFolder& folder_;
    const Options& options_;
    Rank rank_;
    std::optional<Scene> scene_;
    std::optional<TetMesh> cells_;
};

} // namespace vcarve
