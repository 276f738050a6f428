#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The order in which a Hilbert curve comes by places, as indices: what follows each other lies
/// close together. It depends only on where the places are, not on the order they came in, but for
/// those at one place. They must be finite. Cost: O(places log places), in parallel.
std::vector<std::uint32_t> hilbert_order(const std::vector<Eigen::Vector3d>& positions);

/// The indices of the finite points, by x, then y, then z, then index. Cost: a parallel sort.
std::vector<std::uint32_t> lexicographic_sort(const std::vector<Eigen::Vector3d>& positions);

} // namespace vcarve
