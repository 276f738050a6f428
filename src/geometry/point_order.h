#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The indices of positions in the order of a Hilbert curve, so that successive positions are close
/// together. The order does not depend on the input order, except for equal positions. All
/// positions must be finite. Cost: O(positions log positions), in parallel.
std::vector<std::uint32_t> hilbert_order(const std::vector<Eigen::Vector3d>& positions);

/// The indices of finite points, sorted by x, y, z, and index. Cost: a parallel sort.
std::vector<std::uint32_t> lexicographic_sort(const std::vector<Eigen::Vector3d>& positions);

} // namespace vcarve
