#pragma once

#include "steps/2_planes/plane_frame.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace vcarve {

/// The convex hull of places in a plane. Cost: O(places log places).
class PlaneHull {
  public:
    PlaneHull(const std::vector<Eigen::Vector3d>& places, const PlaneFrame& frame);

    /// Whether a place in the plane lies within it or on its border; never where it has no area.
    /// Cost: O(log corners).
    bool contains(const Eigen::Vector3d& place) const;
    /// The hull in triangles; none where it has no area.
    std::vector<std::array<Eigen::Vector3d, 3>> triangles() const;

  private:
    PlaneFrame frame_;
    std::vector<Eigen::Vector2d> corners_; ///< in the plane, counter-clockwise
};

} // namespace vcarve
