#pragma once

#include "base/progress.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Shows visit(from, to) the sight from a point to a view as a segment to the view. The margin (a
/// length) next to the point is left out, half of the sight at most, since points lie a little
/// before or behind the surface.
template <typename Visit>
void visit_sight(const Scene& scene, std::size_t point, std::uint32_t view, double margin,
                 const Visit& visit)
{
    constexpr double kMostOfSight = 0.5;
    const Eigen::Vector3d& center = scene.views[view].center;
    const Eigen::Vector3d way = center - scene.positions[point];
    const double length = way.norm();
    if (length == 0.0) return;
    const double left_out = std::min(margin / length, kMostOfSight);
    visit(scene.positions[point] + left_out * way, center);
}

/// How many sights of a scene, without the margins of their points (visit_sight()), pass through
/// each of some triangles. The tree is over the triangles, which are few; SightTree is the one over
/// all sights, for many questions. Cost: O(triangles log triangles + sights log triangles), in
/// parallel, and about 200 bytes a triangle.
std::vector<std::uint32_t> sights_through(const Scene& scene,
                                          std::span<const std::array<Eigen::Vector3d, 3>> triangles,
                                          const std::vector<double>& margins,
                                          const Progress& progress);

} // namespace vcarve
