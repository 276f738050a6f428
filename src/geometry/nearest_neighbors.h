#pragma once

#include "base/progress.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

namespace vcarve {

/// For each point a list of neighbors of limited length, and the radius that contains them.
/// Memory: 4 bytes per possible neighbor, and 12 bytes per point.
class Neighborhoods {
  public:
    /// No point has neighbors yet. `most` is the maximum number of neighbors per point.
    Neighborhoods(std::size_t num_points, std::size_t most)
        : most_(most), points_(num_points * most), counts_(num_points), reaches_sq_(num_points)
    {
    }

    /// Sets the neighbors of a point, at most `most`, all within the square root of `reach_sq`.
    /// Thread-safe for different points.
    void set(std::size_t point, std::span<const std::uint32_t> around, double reach_sq);

    std::span<const std::uint32_t> around(std::size_t point) const
    {
        return {points_.data() + most_ * point, counts_[point]};
    }
    /// The squared radius that contains the neighbors; 0 for a point without neighbors.
    double reach_sq(std::size_t point) const { return reaches_sq_[point]; }

    /// The squared spacing of points, if the surface is flat.
    double spacing_sq(std::size_t point) const
    {
        return reaches_sq_[point] * std::numbers::pi / static_cast<double>(counts_[point]);
    }

  private:
    std::size_t most_;
    std::vector<std::uint32_t> points_;
    std::vector<std::uint32_t> counts_;
    std::vector<double> reaches_sq_;
};

/// Finds the `count` nearest neighbors of each point, or all other points if there are fewer. The
/// radius is the distance to the farthest. Ties are broken in a way that depends only on the
/// points. Needs at least two points. Uses CGAL's k-d tree. Cost: O(points x (log points + count)),
/// in parallel.
Neighborhoods nearest_neighborhoods(const std::vector<Eigen::Vector3d>& positions,
                                    std::size_t count, const Progress& progress = {});

} // namespace vcarve
