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

/// Where rays come from that show space to be free, and which point each of them reaches. The
/// photographs and scanners of a scene are one source and virtual viewpoints another; the pixels of
/// depth maps would be one more.
struct RaySource {
    std::vector<Eigen::Vector3d> origins; ///< in the frame of the points
    const Tracks* rays = nullptr;         ///< per point, indices into `origins`; not owned
    double weight = 1.0;                  ///< of a ray, relative to a sight of the same point
    /// Whether the rays were measured: then their origins stand in free space, and the space just
    /// behind their points is likely inside. Rays that were inferred speak for outside only.
    bool is_measured = true;
};

/// The sights of a scene as a source, which refers to the scene's tracks.
inline RaySource photographs(const Scene& scene)
{
    RaySource source{.origins = std::vector<Eigen::Vector3d>(scene.views.size()),
                     .rays = &scene.tracks};
    std::ranges::transform(scene.views, source.origins.begin(), &View::center);
    return source;
}

/// Views nobody took, and the points they would have seen: an inference, not evidence.
struct VirtualSights {
    std::vector<Eigen::Vector3d> centers; ///< of the virtual views, in the frame of the points
    Tracks tracks;                        ///< per point, indices into `centers`

    /// As a source of rays, each `weight` of a real sight, which refers to `tracks`.
    RaySource source(double weight) const
    {
        return {.origins = centers, .rays = &tracks, .weight = weight, .is_measured = false};
    }
};

/// Of the arc that leaves each cell by each slot, >= 0.
using ArcCapacities = UnsetArray<std::array<std::int32_t, 4>>;

/// What the sights say about the cells, as a network for the minimum cut: a node a cell, an arc
/// through each facet of a cell. Integers, so sums do not depend on the order of adding.
/// A cut puts every cell on the source side (outside) or the sink side (inside). Its value is the
/// sum of arc_capacities[u][slot] over the facets that lead from the source side to the sink side,
/// plus the source capacities of cells on the sink side, plus the sink capacities of cells on the
/// source side.
struct FlowNetwork {
    ArcCapacities arc_capacities;
    /// Per cell, of its arc from the source where positive (flow that still has to find the sink),
    /// and minus that of its arc to the sink where negative (what the sink still takes).
    UnsetArray<std::int32_t> terminal_capacities;
};

/// How many sights cross each facet: entry [cell][slot], the same on both sides of a facet.
using Crossings = std::vector<std::array<std::uint32_t, 4>>;

/// The visibility terms of the energy that a labelling minimises (Labatut, Pons, Keriven 2009):
/// what all sights say about the cells, in whole steps. `unit` steps are one sight of full weight.
struct VisibilityEnergy {
    /// Each sight's flow is already pushed along its walk; what stays in an infinite cell is left
    /// out, as those are outside anyway.
    FlowNetwork network;
    /// For each origin of measured rays, source after source, the finite cell that holds it, of
    /// several that touch it the first in which a ray ended; kInfinite if it lies out of the hull.
    std::vector<Index> cell_of_view;
    std::int32_t unit = 0;
};

} // namespace vcarve
