#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

namespace vcarve {

/// Counts the rays of a source that cross each facet (Akgunduz, Zetu, Banerjee 2000, section 4.2).
/// `cells` must outlive the counter.
class CrossingCounter {
  public:
    explicit CrossingCounter(const TetMesh& cells) : cells_(cells) {}

    /// Adds the number of rays across each facet, times the weight of the source, rounded down.
    /// Empty `crossings` start at zero. Cost: one walk per ray, in parallel; 16 bytes per cell
    /// beside `crossings`.
    void cast(const RaySource& source, Crossings& crossings, const Progress& progress) const;

  private:
    const TetMesh& cells_;
};

} // namespace vcarve
