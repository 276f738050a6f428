#include "pipeline/rank_shares.h"

#include "base/free_memory.h"
#include "steps/3_cells/triangulate_blocks.h"
#include "steps/4_visibility/trace.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <utility>

namespace vcarve {

template <>
inline constexpr int kNumFields<BlockCells> = 3;
template <typename T>
inline constexpr int kNumFields<SparseSums<T>> = 3;
template <>
inline constexpr int kNumFields<EnergyShare> = 3;

namespace {

// Stages that must be in the work folder before ranks can do their shares.
constexpr std::array<std::string_view, 1> kNeededForBlocks = {"points"};
constexpr std::array<std::string_view, 2> kNeededForRays = {"points", "cells"};

using MakeBlock = std::function<BlockCells()>;

/// The blocks of a rank, which are saved as parts of the checkpoint "cells".
Blocks kept_blocks(const BlocksTask& all, const Rank& rank, Checkpoints& work)
{
    const auto keep = [count = all.count, &work](std::size_t block, const MakeBlock& make) {
        return work.piece({"cells", block, count}, make);
    };
    return {.count = all.count,
            .keep = keep,
            .first = rank.number,
            .step = rank.of,
            .limit = all.limit};
}

StagePiece share_name(const Rank& rank)
{
    return {"rays", rank.number, rank.of};
}

} // namespace

std::optional<TetMesh> triangulate_by_ranks(const BlocksTask& blocks, RunState& run,
                                            const Progress& progress)
{
    const Scene& scene = run.points.scene;
    Checkpoints& work = run.checkpoints;
    // With other ranks, all blocks exist afterwards, unless they gave up.
    const bool is_shared = work.share(kBlocksTask, blocks, kNeededForBlocks, [&] {
        triangulate_share(scene, kept_blocks(blocks, {0, work.num_ranks()}, work),
                          progress.part(0.0, 0.8));
    });
    Blocks all = kept_blocks(blocks, {}, work);
    if (!is_shared) return triangulate_in_blocks(scene, all, progress);
    all.keep = [&](std::size_t block, const MakeBlock& make) {
        return work.shared_piece({"cells", block, blocks.count}, make);
    };
    return triangulate_in_blocks(scene, all, progress.part(0.8, 1.0));
}

VisibilityEnergy walk_by_ranks(RunState& run, const Progress& progress)
{
    constexpr double kWalks = 0.9; // fraction of the time; the rest adds the sums of other ranks
    Checkpoints& work = run.checkpoints;
    const Scales scales = measure_scales(run.cells, run.points.scene);
    const RayCaster caster(run.cells, run.points.scene, scales, run.options().labels.trace);
    const RaySource source = photographs(run.points.scene);
    VisibilityEnergy energy;
    const Rank own = {0, work.num_ranks()};
    const bool is_shared = work.share(kRaysTask, scales, kNeededForRays, [&] {
        energy = caster.energy_of(source, share_of(*source.rays, own), progress.part(0.0, kWalks));
    });
    if (!is_shared) {
        caster.cast(source, energy, progress);
        return energy;
    }
    for (Rank rank = {1, own.of}; rank.number < rank.of; ++rank.number) {
        caster.add(work.shared_piece(
                       share_name(rank),
                       [&] { return caster.share(source, share_of(*source.rays, rank), {}); }),
                   energy);
    }
    caster.finish(source, energy);
    return energy;
}

VertexRun share_of(const Tracks& rays, const Rank& rank)
{
    const auto begin_of = [&](std::size_t number) {
        const std::uint64_t before = rays.views.size() * number / rank.of;
        const auto begin = std::ranges::lower_bound(rays.begins, before);
        return number == rank.of ? static_cast<Index>(rays.size())
                                 : static_cast<Index>(begin - rays.begins.begin());
    };
    return {begin_of(rank.number), begin_of(rank.number + 1)};
}

const Scene& RankShares::scene()
{
    if (!points_) map_kept(folder_, "points", points_.emplace());
    return points_->scene;
}

const TetMesh& RankShares::cells()
{
    if (!cells_) map_kept(folder_, "cells", cells_.emplace());
    return *cells_;
}

void RankShares::triangulate(std::string_view file, Log& log)
{
    BlocksTask task;
    folder_.map(file, task);
    Checkpoints work(&folder_, log);
    Stage stage(work.log(), "triangulate");
    triangulate_share(scene(), kept_blocks(task, rank_, work), stage);
    return_freed_memory();
}

void RankShares::walk_rays(std::string_view file, Log& log)
{
    Scales scales;
    folder_.map(file, scales);
    Checkpoints work(&folder_, log);
    Stage stage(work.log(), "rays");
    const RayCaster caster(cells(), scene(), scales, options_.labels.trace);
    const RaySource source = photographs(scene());
    work.piece(share_name(rank_),
               [&] { return caster.share(source, share_of(*source.rays, rank_), stage); });
}

void RankShares::work(std::string_view task, Log& log)
{
    tbb::task_arena arena(options_.threads == 0 ? tbb::task_arena::automatic : options_.threads);
    arena.execute([&] {
        if (task.starts_with(kBlocksTask)) {
            triangulate(task, log);
        } else if (task.starts_with(kRaysTask)) {
            walk_rays(task, log);
        } else {
            throw std::logic_error("unknown task for a rank");
        }
    });
}

} // namespace vcarve
