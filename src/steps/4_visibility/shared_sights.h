#pragma once

#include "io/work/kept_fields.h"
#include "io/work/stage_keeper.h"
#include "model/ray_source.h"
#include "steps/4_visibility/each_vertex.h"
#include "steps/4_visibility/scales.h"
#include "steps/4_visibility/trace.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Lines of sight that several ranks walk: each those to a run of points, through all cells. What
// they say are integers, so their sums are what one rank alone would get.

namespace vcarve {

/// What the name of a task for ranks begins with, and the stages that it takes.
inline constexpr std::string_view kSightsTask = "task-sights";
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

/// What sights are walked for: a stage, and what their weights are relative to.
struct SightsOfStage {
    std::string_view name;
    Scales scales;
};

/// What other ranks have to be told of a source that is walked.
inline SightsTask task_of(const RaySource& source, const SightsOfStage& stage)
{
    SightsTask task;
    task.stage = stage.name;
    task.scales = stage.scales;
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

/// Casts rays by ranks: a RayCaster or a CrossingCounter, and the stages of the run. Both must
/// outlive it.
template <typename Caster>
class CasterOfRanks {
  public:
    CasterOfRanks(const Caster& caster, StageKeeper& work) : caster_(caster), work_(work) {}

    /// What the caster's cast() does, with the other ranks. A share that is missing, or cannot be
    /// read, is walked here.
    template <typename Said>
    void cast(const RaySource& source, const SightsOfStage& stage, Said& said,
              const Progress& progress) const
    {
        if (work_.num_ranks() == 1) return caster_.cast(source, said, progress);
        const SightsTask task = task_of(source, stage);
        constexpr double kWalks = 0.9; // of the time; the rest is adding what others say
        const std::size_t ranks = work_.num_ranks();
        Said sum;
        const bool is_shared = work_.share(kSightsTask, task, kNeededForSights, [&] {
            sum = caster_.said_of(source, share_of(*source.rays, {0, ranks}),
                                  progress.part(0.0, kWalks));
        });
        if (!is_shared) return caster_.cast(source, said, progress);
        for (std::size_t number = 1; number < ranks; ++number) {
            const VertexRun points = share_of(*source.rays, {number, ranks});
            caster_.add(work_.shared_piece({task.stage, number, ranks},
                                           [&] { return caster_.share(source, points, {}); }),
                        sum);
        }
        caster_.finish(source, std::move(sum), said);
    }

    /// The share of a rank, which is kept: walked by that rank, for the first.
    typename Caster::Share share(const RaySource& source, const SightsTask& task, const Rank& rank,
                                 const Progress& progress) const
    {
        return work_.piece({task.stage, rank.number, rank.of}, [&] {
            return caster_.share(source, share_of(*source.rays, rank), progress);
        });
    }

  private:
    const Caster& caster_;
    StageKeeper& work_;
};

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
