#pragma once

#include "base/arrays.h"
#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Origins of rays through free space, and the points that the rays reach. The photographs and
/// scanners of a scene are one source, virtual viewpoints another. Pixels of depth maps could be a
/// third.
struct RaySource {
    std::vector<Eigen::Vector3d> origins; ///< in the frame of the points
    const Tracks* rays = nullptr;         ///< per point, indices into `origins`; not owned
    double weight = 1.0;                  ///< of a ray, relative to other rays of its point
    /// Whether the rays were measured. If so, their origins are in free space, and the space just
    /// behind their points is likely inside. Inferred rays vote for outside only.
    bool is_measured = true;
};

/// The rays of a scene as a source. Keeps a pointer to the scene's tracks.
inline RaySource photographs(const Scene& scene)
{
    RaySource source{.origins = std::vector<Eigen::Vector3d>(scene.views.size()),
                     .rays = &scene.tracks};
    std::ranges::transform(scene.views, source.origins.begin(), &View::center);
    return source;
}

/// Virtual viewpoints and the points visible from them: an inference, not evidence.
struct VirtualRays {
    std::vector<Eigen::Vector3d> centers; ///< the viewpoints, in the frame of the points
    Tracks tracks;                        ///< per point, indices into `centers`

    /// These rays as a source, with `weight` relative to real rays. Keeps a pointer to `tracks`.
    RaySource source(double weight) const
    {
        return {.origins = centers, .rays = &tracks, .weight = weight, .is_measured = false};
    }
};

/// The capacity, >= 0, of the arc from each cell through each slot.
using ArcCapacities = UnsetArray<std::array<std::int32_t, 4>>;

/// The votes of the rays as a network for the minimum cut: one node per cell, and an arc through
/// each facet of a cell. Capacities are integers, so sums do not depend on the order of addition.
/// A cut puts every cell on the source side (outside) or the sink side (inside). Its value is the
/// sum of arc_capacities[u][slot] over the facets that lead from the source side to the sink side,
/// plus the source capacities of cells on the sink side, plus the sink capacities of cells on the
/// source side.
struct FlowNetwork {
    ArcCapacities arc_capacities;
    /// Per cell: if positive, the capacity of the arc from the source (excess flow that still has
    /// to reach the sink); if negative, minus the residual capacity of the arc to the sink.
    UnsetArray<std::int32_t> terminal_capacities;
};

/// The number of rays through each facet: entry [cell][slot], equal on both sides of a facet.
using Crossings = std::vector<std::array<std::uint32_t, 4>>;

/// The visibility terms of the energy that a labeling minimizes (Labatut, Pons, Keriven 2009): the
/// votes of all rays, as integers. `unit` is the weight of one full ray.
struct VisibilityEnergy {
    /// The flow of each ray is already pushed along its walk. Excess in infinite cells is omitted,
    /// because they are outside anyway.
    FlowNetwork network;
    /// The finite cell that contains each origin of measured rays, source after source; kInfinite
    /// if it is outside the hull. If several cells touch it: the first in which a ray ended.
    std::vector<Index> cell_of_view;
    std::int32_t unit = 0;
};

} // namespace vcarve
