#pragma once

#include "io/work/kept_fields.h"
#include "io/work/stage_keeper.h"
#include "model/ray_source.h"
#include "steps/3_visibility/each_vertex.h"
#include "steps/3_visibility/scales.h"
#include "steps/3_visibility/trace.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

// Lines of sight that several ranks walk: each those to a run of points, through all cells. What
// they say are integers, so their sums are what one rank alone would get.

namespace vcarve {

/// Under what name a task for ranks is kept, and the stages it needs.
inline constexpr std::string_view kSightsTask = "sights-to-walk";
inline constexpr std::array<std::string_view, 2> kNeededForSights = {"points", "cells"};

/// Rays that ranks are to walk.
struct SightsTask {
    std::string stage; ///< of which each rank's share is a part
    Scales scales;
    bool of_photographs = true; ///< those of the scene; else these:
    std::vector<Eigen::Vector3d> origins;
    Tracks rays;
    double weight = 1.0;

    /// As RaySource; `scene` and the task must outlive it.
    RaySource source(const Scene& scene) const
    {
        if (of_photographs) return photographs(scene);
        return {.origins = origins, .rays = &rays, .weight = weight, .is_measured = false};
    }
};

/// What other ranks have to be told of a source that is walked for a stage.
inline SightsTask task_of(const RaySource& source, std::string_view stage, const Scales& scales)
{
    SightsTask task;
    task.stage = stage;
    task.scales = scales;
    task.of_photographs = source.is_measured;
    if (task.of_photographs) return task;
    task.origins = source.origins;
    task.rays = *source.rays;
    task.weight = source.weight;
    return task;
}

/// The points whose rays a rank walks: as many rays as any other, but for those of a point.
inline VertexRun share_of(const Tracks& rays, const Rank& rank)
{
    const auto begin_of = [&](std::size_t number) {
        const std::uint64_t before = rays.views.size() * number / rank.of;
        const auto begin = std::ranges::lower_bound(rays.begins, before);
        return number == rank.of ? static_cast<Index>(rays.size())
                                 : static_cast<Index>(begin - rays.begins.begin());
    };
    return {begin_of(rank.number), begin_of(rank.number + 1)};
}

/// What a caster's cast() does, with the other ranks. A share that is missing or damaged is walked
/// here.
template <typename Caster, typename Said>
void cast_among_ranks(const Caster& caster, const RaySource& source, const SightsTask& task,
                      StageKeeper& work, Said& said, const Progress& progress)
{
    constexpr double kWalks = 0.9; // of the time; the rest is adding what others say
    const std::size_t ranks = work.num_ranks();
    Said sum;
    const bool is_shared = work.share(kSightsTask, task, kNeededForSights, [&] {
        sum =
            caster.said_of(source, share_of(*source.rays, {0, ranks}), progress.part(0.0, kWalks));
    });
    if (!is_shared) return caster.cast(source, said, progress);
    for (std::size_t number = 1; number < ranks; ++number) {
        const VertexRun points = share_of(*source.rays, {number, ranks});
        caster.add(work.shared_piece({task.stage, number, ranks},
                                     [&] { return caster.share(source, points, {}); }),
                   sum);
    }
    caster.finish(source, std::move(sum), said);
}

/// The other side of it: walks the share of another rank, and keeps what it says.
template <typename Caster>
void cast_share(const Caster& caster, const RaySource& source, const SightsTask& task,
                const Rank& rank, StageKeeper& work, const Progress& progress)
{
    work.piece({task.stage, rank.number, rank.of},
               [&] { return caster.share(source, share_of(*source.rays, rank), progress); });
}

template <>
struct KeptFields<Tracks> {
    static void visit(const auto& field, auto& tracks)
    {
        field(tracks.begins);
        field(tracks.views);
    }
};

template <>
struct KeptFields<SightsTask> {
    static void visit(const auto& field, auto& task)
    {
        field(task.stage);
        field(task.scales);
        field(task.of_photographs);
        field(task.origins);
        field(task.rays);
        field(task.weight);
    }
};

template <typename T>
struct KeptFields<SparseSums<T>> {
    static void visit(const auto& field, auto& sums)
    {
        field(sums.count);
        field(sums.runs);
        field(sums.values);
    }
};

template <>
struct KeptFields<EnergyShare> {
    static void visit(const auto& field, auto& share)
    {
        field(share.arc_capacities);
        field(share.terminal_capacities);
        field(share.cell_of_view);
    }
};

} // namespace vcarve
