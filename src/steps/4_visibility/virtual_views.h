#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

namespace vcarve {

/// More viewpoints (Akgunduz, Zetu, Banerjee 2000, who leave them to the future). They stand in
/// cells that are labelled outside and crossed by a real sight, near the points but not at them,
/// spread as far as they go. A viewpoint sees those of the 1000 points around it which some view
/// saw, at which the surface as labelled looks towards it, and which nothing known to be solid
/// hides: no cell that is labelled inside and lies just behind a point that a view saw. Cells
/// labelled inside of which the sights say nothing hide nothing: they are what is to be found out.
/// The result does not depend on the number of threads. Cost: two walks a real sight, up to 1000 a
/// viewpoint, and O(cells x viewpoints) to spread them, all in parallel.
VirtualSights find_virtual_sights(const TetMesh& cells, const Scene& scene, const Labels& labels,
                                  const VirtualViewOptions& options, const Progress& progress);

} // namespace vcarve
