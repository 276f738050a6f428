#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The indices of the finite points, by x, then y, then z, then index. Cost: a parallel sort.
std::vector<std::uint32_t> lexicographic_sort(const std::vector<Eigen::Vector3d>& positions);

} // namespace vcarve
