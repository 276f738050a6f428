#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>

namespace vcarve {

/// A plane.
struct Plane {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< one of its points
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit

    /// How far before it a place lies; negative behind it.
    double height_of(const Eigen::Vector3d& place) const { return normal.dot(place - center); }
};

/// Coordinates in a plane.
class PlaneFrame {
  public:
    explicit PlaneFrame(const Plane& plane)
        : center_(plane.center), x_(across(plane.normal)), y_(plane.normal.cross(x_))
    {
    }

    Eigen::Vector2d in_plane(const Eigen::Vector3d& place) const
    {
        return {x_.dot(place - center_), y_.dot(place - center_)};
    }
    Eigen::Vector3d in_space(const Eigen::Vector2d& place) const
    {
        return center_ + place.x() * x_ + place.y() * y_;
    }

  private:
    /// A unit vector at right angles to another. It turns little where that does: rounding must not
    /// choose the axis it is made of, as where two of its components are next to nothing.
    static Eigen::Vector3d across(const Eigen::Vector3d& normal)
    {
        constexpr double kFlat = 0.593; // above 1 / sqrt(3), so that one component is below
        const int axis = std::abs(normal.x()) < kFlat ? 0 : std::abs(normal.y()) < kFlat ? 1 : 2;
        return normal.cross(Eigen::Vector3d::Unit(axis)).normalized();
    }

    Eigen::Vector3d center_;
    Eigen::Vector3d x_;
    Eigen::Vector3d y_;
};

} // namespace vcarve
