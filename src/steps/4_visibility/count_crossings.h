#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"

namespace vcarve {

/// Counts how many rays of a source cross each facet (Akgunduz, Zetu, Banerjee 2000, section 4.2).
/// `cells` must outlive it.
class CrossingCounter {
  public:
    explicit CrossingCounter(const TetMesh& cells) : cells_(cells) {}

    /// Adds to each facet how many rays cross it, times the weight of the source and rounded down.
    /// Crossings that are empty begin at zero. Cost: one walk a ray, in parallel; 16 bytes a cell,
    /// and as many more where the crossings are not empty.
    void cast(const RaySource& source, Crossings& crossings, const Progress& progress) const;

  private:
    const TetMesh& cells_;
};

} // namespace vcarve
