#pragma once

#include "steps/1_points/plane_frame.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <Eigen/Core>

#include <array>
#include <vector>

namespace vcarve {

/// The convex hull of places in a plane. Cost: O(places log places).
class PlaneHull {
  public:
    PlaneHull(const std::vector<Eigen::Vector3d>& places, const PlaneFrame& frame);

    /// Whether a place in the plane lies within it or on its border. Cost: O(log
    /// corners).
    bool contains(const Eigen::Vector3d& place) const;
    /// The hull in triangles; none where it has no area.
    std::vector<std::array<Eigen::Vector3d, 3>> triangles() const;

  private:
    using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

    Kernel::Point_2 in_plane(const Eigen::Vector3d& place) const;
    Eigen::Vector3d in_space(const Kernel::Point_2& at) const;

    PlaneFrame frame_;
    std::vector<Kernel::Point_2> corners_; ///< counter-clockwise
};

} // namespace vcarve
