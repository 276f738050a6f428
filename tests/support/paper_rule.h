#pragma once

#include "model/tet_mesh.h"
#include "vcarve/scene.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// What the test of Akgunduz, Zetu, Banerjee (2000, section 4.2) says about a facet.
enum class Mark : std::uint8_t { none, unclear, redundant };

/// Tries every sight with every facet in plain floating point: the sight meets the facet's plane on
/// its way, and seen from there, in the axis-aligned projection in which the facet is largest, its
/// three edges subtend angles that add up to a full turn within 0.01. Unclear are facets that some
/// sight passes so close to the line of an edge that the tolerance can decide, or whose plane holds
/// the sight's end, and that no other sight crosses clearly. Facets at the point of a sight are not
/// met by it. One mark a slot of a finite
/// cell, none at infinite ones.
std::vector<std::array<Mark, 4>> marks_by_paper_rule(const TetMesh& mesh, const Scene& scene);

} // namespace vcarve
