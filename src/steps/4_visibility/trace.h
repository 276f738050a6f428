#pragma once

#include "base/parallel.h"
#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/4_visibility/energy_sums.h"
#include "steps/4_visibility/sight_weights.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The vertices from `first` up to `last`, and without that.
struct VertexRun {
    Index first = 0;
    Index last = 0;
};

inline VertexRun all_vertices(const TetMesh& cells)
{
    return {0, static_cast<Index>(cells.positions.size())};
}

/// Calls body(first, last) for shorter runs of vertices [first, last) in parallel, which together
/// are `all`, and tells how far it is.
template <typename Body>
void for_each_run_of_vertices(const VertexRun& all, const Progress& progress, const Body& body)
{
    constexpr std::size_t kRun = 512;
    const std::size_t count = all.last - all.first;
    parallel_for((count + kRun - 1) / kRun, progress,
                 [&](std::size_t run) {
                     body(all.first + static_cast<Index>(run * kRun),
                          all.first + static_cast<Index>(std::min(count, (run + 1) * kRun)));
                 },
                 1);
}

/// Calls body(vertex) for every vertex in parallel and tells how far it is.
template <typename Body>
void for_each_vertex(const TetMesh& cells, const Progress& progress, const Body& body)
{
    for_each_run_of_vertices(all_vertices(cells), progress, [&](Index first, Index last) {
        for (Index vertex = first; vertex < last; ++vertex) {
            body(vertex);
        }
    });
}

/// What the rays to some of the points say, without the cells of which they say nothing.
struct EnergyShare {
    SparseSums<std::array<std::int32_t, 4>> arc_capacities;
    SparseSums<std::int32_t> terminal_capacities;
    std::vector<Index> cell_of_view; ///< of the origins of the source, where it is measured
};

/// After how many facets rays to points of a dense cloud become bundles, and after how many these
/// become bundles of bundles.
inline constexpr std::array<int, 2> kBundledAfter = {16, 40};

/// Adds the visibility terms of sources to an energy. `cells`, `scene` and `options` must outlive
/// it; `scene` has the points of the cells, which weigh their rays.
///
/// Each ray asks for the cells before its point to be outside and, if it was measured, for the cell
/// behind it to be inside (Labatut, Pons, Keriven 2009), softly near the point; but not behind a
/// point along a border (PointKind::border), where what lies behind often is free. The terms are
/// integers, so their sums do not depend on the number of threads. The flow of each ray is pushed
/// along its walk at once, which leaves the minimum cut as it is (docs/algorithm.md). Where a ray
/// meets an edge or a vertex no facet leads its flow on: each stretch between such places ends in a
/// source (behind the point a sink) of its own, as strong as the term of the ray for what comes
/// next.
///
/// Near sights of a dense cloud say the same far from their points. So after kBundledAfter[0]
/// facets only one of `bundle_sights` walks on, with the weight of all, and after kBundledAfter[1]
/// only one of as many of these; the others end there and ask for the cell they reached to be
/// outside.
class RayCaster {
  public:
    RayCaster(const TetMesh& cells, const Scene& scene, const Scales& scales,
              const TraceOptions& options)
        : cells_(cells), scene_(scene), scales_(scales), options_(options)
    {
    }

    using Share = EnergyShare;

    /// Adds the terms of all rays of a source. An energy that is empty begins at zero. The cells of
    /// the origins of measured rays are appended to VisibilityEnergy::cell_of_view. Throws
    /// InputError if a sum leaves 32 bits. Cost: one walk a ray, in parallel; 20 bytes a cell, and
    /// as many more where the energy is not empty.
    void cast(const RaySource& source, VisibilityEnergy& energy, const Progress& progress) const;

    // The same in steps, for who shares the work with others.

    /// What the rays to a run of points say by themselves.
    VisibilityEnergy said_of(const RaySource& source, const VertexRun& points,
                             const Progress& progress) const;
    Share share(const RaySource& source, const VertexRun& points, const Progress& progress) const;
    /// Adds what the rays of the same source to other points say.
    void add(const Share& share, VisibilityEnergy& said) const;
    /// Adds what all rays of a source say to an energy, as cast() does.
    void finish(const RaySource& source, VisibilityEnergy said, VisibilityEnergy& energy) const;

  private:
    const TetMesh& cells_;
    const Scene& scene_;
    Scales scales_;
    const TraceOptions& options_;
};

} // namespace vcarve
