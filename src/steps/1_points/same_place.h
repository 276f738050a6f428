#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// Which points are at one place: for every point the first of those at its place, which may be the
/// point itself. Points are at one place if they are nearer to each other, along each axis, than
/// 1e-9 of the diagonal of the box of the middle half of all, or if others lie between them so;
/// where these would be more than 8, which may be a part of the scene that lies far from the rest,
/// they are judged by themselves in the same way, and by the rounding of their coordinates. COLMAP
/// often has a point twice, triangulated from other views of the same track, and the two differ in
/// their last digits; which digits those are depends on where the model lies. Distances that
/// photographs can tell are a million times as large. Only the points in `finite` count, each of
/// which must be finite; any other is alone. The result does not depend on where and how large the
/// scene is, up to rounding. Cost: O(points log points), in parallel.
std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite);

} // namespace vcarve
