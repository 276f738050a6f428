#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "geometry/point_tree.h"
#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

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

/// Of points in rows and columns many are equally far; lengths that differ by such a share count as
/// equal, so that rounding does not tell which of them are asked.
inline constexpr double kRounding = 1e-6;

/// Points that lie on a plane. It stays where it is made, since its tree refers to the positions.
struct PlanarRegion {
    Plane plane;                            ///< its normal looks to the views that saw the points
    double spacing;                         ///< how far its points stand apart: the median
    std::vector<std::uint32_t> points;      ///< ascending
    std::vector<Eigen::Vector3d> positions; ///< of these
    PointTree tree;                         ///< of the positions

    PlanarRegion(const Scene& scene, const Plane& fitted, double median_spacing,
                 std::vector<std::uint32_t> of);
    PlanarRegion(const PlanarRegion&) = delete;
    PlanarRegion& operator=(const PlanarRegion&) = delete;

    /// The points nearest to a place: so many, and those as near as the last of them.
    std::vector<std::uint32_t> nearest(const Eigen::Vector3d& place, std::size_t count) const;
    /// The corners of the convex hull of its points in its plane, counter-clockwise.
    std::vector<Eigen::Vector3d> hull() const;
    /// Whether a point is no farther than so far from a place.
    bool has_point_near(const Eigen::Vector3d& place, double distance) const;
};

/// The planar regions of a scene, and whose its points are. Keeps a reference to the positions.
struct PlanarRegions {
    static constexpr std::uint32_t kNone = 0xffffffffU;

    NearestNeighbors tree;                ///< of all points
    std::deque<PlanarRegion> regions;     ///< the flattest first
    std::vector<std::uint32_t> region_of; ///< per point; kNone where it is of none
    std::vector<double> spacings;         ///< per point: how far those around it stand apart

    explicit PlanarRegions(const Scene& scene);
};

/// The parts of the surface that are planar, by growing regions from the flattest points on
/// (Poppinga, Vaskevicius, Birk & Pathak 2008). The points of the scene must follow each other in
/// space.
///
/// A point is flat if the 12 points nearest to it and it lie within a seventh of their spacing of a
/// plane (root of the mean square). From there a region takes in those of the 12 points around each
/// of its points that its views look at from the same side and that lie no farther from its plane
/// than a seventh of the spacing around; the plane is fitted anew whenever the points have doubled.
/// In a dense cloud it is three standard deviations of the noise, where these are more: what the
/// median point and those around lie off a plane. A point of hundreds that grew from another and
/// are no region begins no growth of its own, so that noise is not looked at again and again.
///
/// Such a slab can be laid through anything that has points enough: through noise, of which it is
/// a slice, and along something round, which bends out of it. In both many points lie right beside
/// it. So 12 points or more are a region if of the points around them that lie in a slab three
/// times as thick at least four in five are its own.
///
/// The result does not depend on the number of threads nor on where the scene lies or how large it
/// is, up to rounding. Cost: O(points log points + sights), in parallel, and 90 bytes a point and 4
/// for each of up to 16 threads.
PlanarRegions planar_regions(const Scene& scene, const Progress& progress);

} // namespace vcarve
