#pragma once

#include "base/progress.h"
#include "model/ray_source.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "steps/4_visibility/each_vertex.h"
#include "steps/4_visibility/sparse_sums.h"

#include <array>
#include <cstdint>

namespace vcarve {

/// Counts how many rays of a source cross each facet (Akgunduz, Zetu, Banerjee 2000, section 4.2).
/// `cells` must outlive it.
class CrossingCounter {
  public:
    using Share = SparseSums<std::array<std::uint32_t, 4>>;

    explicit CrossingCounter(const TetMesh& cells) : cells_(cells) {}

    /// Adds to each facet how many rays cross it, times the weight of the source and rounded down.
    /// Crossings that are empty begin at zero. Cost: one walk a ray, in parallel; 16 bytes a cell,
    /// and as many more where the crossings are not empty.
    void cast(const RaySource& source, Crossings& crossings, const Progress& progress) const;

    // The same in steps, for who shares the work with others.

    /// How many of the rays to a run of points cross each facet.
    Crossings said_of(const RaySource& source, const VertexRun& points,
                      const Progress& progress) const;
    Share share(const RaySource& source, const VertexRun& points, const Progress& progress) const;
    /// Adds how many of the rays to other points do.
    void add(const Share& share, Crossings& said) const;
    /// Adds what all rays of a source say to crossings, as cast() does.
    void finish(const RaySource& source, const Crossings& said, Crossings& crossings) const;

  private:
    const TetMesh& cells_;
};

} // namespace vcarve
