#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/4_visibility/energy_sums.h"
#include "steps/4_visibility/ray_weights.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Calls body(first, last) in parallel for short runs of vertices [first, last), which are all
/// together, and reports progress.
template <typename Body>
void for_each_run_of_vertices(const TetMesh& cells, const Progress& progress, const Body& body)
{
    constexpr std::size_t kRun = 512;
    const std::size_t count = cells.positions.size();
    parallel_for((count + kRun - 1) / kRun, progress,
                 [&](std::size_t run) {
                     body(static_cast<Index>(run * kRun),
                          static_cast<Index>(std::min(count, (run + 1) * kRun)));
                 },
                 1);
}

/// Calls body(vertex) for every vertex in parallel and reports progress.
template <typename Body>
void for_each_vertex(const TetMesh& cells, const Progress& progress, const Body& body)
{
    for_each_run_of_vertices(cells, progress, [&](Index first, Index last) {
        for (Index vertex = first; vertex < last; ++vertex) {
            body(vertex);
        }
    });
}

/// The numbers of facets after which rays to points of a dense cloud become bundles, and bundles
/// become bundles of bundles.
inline constexpr std::array<int, 2> kBundledAfter = {16, 40};

/// Adds the visibility terms of sources to an energy. `cells`, `scene` and `options` must outlive
/// it. `scene` has the points of the cells, which determine the weights of their rays.
///
/// Each ray votes for the cells in front of its point to be outside and, if it was measured, for
/// the cell behind the point to be inside (Labatut, Pons, Keriven 2009). Votes are weaker near the
/// point. Points on a border (PointKind::border) do not vote for inside, because the space behind
/// them is often free. Neither do witnesses, whose rays count for all points that they represent
/// and continue without bundles. Terms are integers, so their sums do not depend on the thread
/// count.
///
/// The flow of a ray is pushed along its walk at once, which does not change the minimum cut
/// (docs/algorithm.md). If a ray meets an edge or a vertex, no facet passes its flow on. Each
/// stretch between such positions ends in a separate source (behind the point: a sink), whose
/// capacity is the ray's next term.
///
/// Neighboring rays of a dense cloud cross the same cells far from their points. So after
/// kBundledAfter[0] facets one of `bundle_rays` rays continues with the weight of all, and after
/// kBundledAfter[1] one of as many bundles. The others vote for the cell they reached, and end.
class RayCaster {
  public:
    RayCaster(const TetMesh& cells, const Scene& scene, const Scales& scales,
              const TraceOptions& options)
        : cells_(cells), scene_(scene), scales_(scales), options_(options)
    {
    }

    /// Adds the terms of all rays of a source. An empty energy starts at zero. Sets
    /// VisibilityEnergy::cell_of_view for a measured source. Throws InputError if the sum of a cell
    /// is too large for 32 bits. Cost: one walk per ray, in parallel; 20 bytes per cell.
    void cast(const RaySource& source, VisibilityEnergy& energy, const Progress& progress) const;

  private:
    const TetMesh& cells_;
    const Scene& scene_;
    Scales scales_;
    const TraceOptions& options_;
};

} // namespace vcarve
