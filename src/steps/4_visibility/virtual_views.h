#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

namespace vcarve {

/// Virtual viewpoints (Akgunduz, Zetu, Banerjee 2000, who leave them to future work). They are in
/// outside cells that a real ray crosses, near the points but not at them, as far apart as
/// possible. A viewpoint sees those of the nearest 1000 points that a view saw, if the labeled
/// surface there faces the viewpoint and no known solid occludes them. Known solids are inside
/// cells directly behind a point that a view saw. Other inside cells do not occlude, because
/// virtual rays are to test them. The result does not depend on the thread count. Cost: two walks
/// per real ray, up to 1000 per viewpoint, and O(cells x viewpoints) to spread them, in parallel.
VirtualRays find_virtual_rays(const TetMesh& cells, const Scene& scene, const Labels& labels,
                              const VirtualViewOptions& options, const Progress& progress);

} // namespace vcarve
