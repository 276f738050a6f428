#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// How many sights of a scene pass through each of some triangles. Of a sight the margin of its
/// point (a length, one a point) is left out, half of the sight at most, since points lie a little
/// before or behind the surface. The tree is over the triangles, which are few; SightTree is the
/// one over all sights, for many questions. Cost: O(triangles log triangles + sights log
/// triangles), in parallel, and about 200 bytes a triangle.
std::vector<std::uint32_t> sights_through(const Scene& scene,
                                          std::span<const std::array<Eigen::Vector3d, 3>> triangles,
                                          const std::vector<double>& margins,
                                          const Progress& progress);

} // namespace vcarve
