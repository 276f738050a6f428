#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The result for a facet of the test of Akgunduz, Zetu, Banerjee (2000, section 4.2).
enum class Mark : std::uint8_t { none, unclear, redundant };

/// Tests every ray with every facet in plain floating point. A facet is redundant if a ray meets
/// its plane and the facet's edges subtend a full turn, within 0.01, at the crossing. Angles are
/// measured in the axis-aligned projection in which the facet is largest. A facet is unclear if a
/// ray passes an edge within the tolerance or ends in the facet's plane, and no other ray crosses
/// clearly. A ray does not meet the facets at its own point. Returns one mark per slot of a finite
/// cell; infinite cells have none.
std::vector<std::array<Mark, 4>> marks_by_paper_rule(const TetMesh& mesh, const Scene& scene);

} // namespace vcarve
