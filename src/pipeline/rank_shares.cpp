#include "pipeline/rank_shares.h"

#include "base/freed_memory.h"
#include "steps/3_cells/kept_block.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/shared_sights.h"
#include "steps/4_visibility/trace.h"

#include <tbb/task_arena.h>

#include <functional>
#include <stdexcept>
#include <utility>

namespace vcarve {

Blocks kept_blocks(std::size_t count, StageKeeper& work)
{
    return {count, [count, &work](std::size_t block, const std::function<BlockCells()>& make) {
                return work.piece({"cells", block, count}, make);
            }};
}

SharedBlocks::SharedBlocks(std::size_t count, StageKeeper& work) : work_(work), held_(count) {}

Blocks SharedBlocks::own()
{
    const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    if (held_.size() > threads * work_.num_ranks()) return kept_blocks(held_.size(), work_);
    return {held_.size(), [this](std::size_t block, const std::function<BlockCells()>& make) {
                held_[block] = make();
                return BlockCells();
            }};
}

Blocks SharedBlocks::all()
{
    return {held_.size(), [this](std::size_t block, const std::function<BlockCells()>& make) {
                if (held_[block]) return std::move(*std::exchange(held_[block], {}));
                return work_.shared_piece({"cells", block, held_.size()}, make);
            }};
}

const Scene& RankShares::scene()
{
    if (!scene_) {
        Scene scene;
        map_stage(folder_, "points", scene);
        scene_ = std::move(scene);
    }
    return *scene_;
}

const TetMesh& RankShares::cells()
{
    if (!cells_) {
        TetMesh cells;
        map_stage(folder_, "cells", cells);
        cells_ = std::move(cells);
    }
    return *cells_;
}

void RankShares::triangulate(std::string_view file, Log& log)
{
    BlocksTask task;
    folder_.map(file, task);
    StageKeeper work(&folder_, log);
    Stage stage(work.log(), "triangulate");
    triangulate_share(scene(), kept_blocks(task.count, work), rank_, stage);
    return_freed_memory();
}

void RankShares::walk_sights(std::string_view file, Log& log)
{
    SightsTask task;
    folder_.map(file, task);
    const RaySource source = task.source(scene());
    StageKeeper work(&folder_, log);
    Stage stage(work.log(), "sights");
    if (options_.labels.method == Method::strict) {
        const CrossingCounter counter(cells());
        CasterOfRanks(counter, work).share(source, task, rank_, stage);
    } else {
        const RayCaster caster(cells(), scene(), task.scales, options_.labels.trace);
        CasterOfRanks(caster, work).share(source, task, rank_, stage);
    }
}

void RankShares::work(std::string_view task, Log& log)
{
    tbb::task_arena arena(options_.threads == 0 ? tbb::task_arena::automatic : options_.threads);
    arena.execute([&] {
        if (task.starts_with(kBlocksTask)) {
            triangulate(task, log);
        } else if (task.starts_with(kSightsTask)) {
            walk_sights(task, log);
        } else {
            throw std::logic_error("a rank is asked for what it does not know");
        }
    });
}

} // namespace vcarve
