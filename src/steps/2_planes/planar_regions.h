#pragma once

#include "base/progress.h"
#include "geometry/nearest_neighbors.h"
#include "geometry/point_tree.h"
#include "model/usual_values.h"
#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <vector>

namespace vcarve {

/// An oriented plane.
struct Plane {
    Eigen::Vector3d center = Eigen::Vector3d::Zero();  ///< a point on it
    Eigen::Vector3d normal = Eigen::Vector3d::UnitZ(); ///< unit

    /// The signed distance of a position; negative behind the plane.
    double height_of(const Eigen::Vector3d& place) const { return normal.dot(place - center); }
};

/// 2D coordinates in a plane.
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
    /// A unit vector perpendicular to `normal`, which changes little with it. A threshold selects
    /// the axis. The smallest component would depend on rounding if two are almost zero.
    static Eigen::Vector3d across(const Eigen::Vector3d& normal)
    {
        constexpr double kFlat = 0.593; // above 1 / sqrt(3), so one component is smaller
        const int axis = std::abs(normal.x()) < kFlat ? 0 : std::abs(normal.y()) < kFlat ? 1 : 2;
        return normal.cross(Eigen::Vector3d::Unit(axis)).normalized();
    }

    Eigen::Vector3d center_;
    Eigen::Vector3d x_;
    Eigen::Vector3d y_;
};

/// Relative tolerance for equal lengths. Many points of a grid are equally far, and rounding must
/// not select among them.
inline constexpr double kRounding = 1e-6;

/// The points on a plane. Not movable, because the tree refers to the positions.
struct PlanarRegion {
    Plane plane;                            ///< the normal points towards the views
    double spacing;                         ///< median distance between its points
    std::vector<std::uint32_t> points;      ///< ascending
    std::vector<Eigen::Vector3d> positions; ///< of `points`
    PointTree tree;                         ///< of `positions`

    PlanarRegion(const Scene& scene, const Plane& fitted, double median_spacing,
                 std::vector<std::uint32_t> of);
    PlanarRegion(const PlanarRegion&) = delete;
    PlanarRegion& operator=(const PlanarRegion&) = delete;

    /// The `count` points nearest to a position, and others as far as the last.
    std::vector<std::uint32_t> nearest(const Eigen::Vector3d& place, std::size_t count) const;
    /// The corners of the convex hull of the points in the plane, counter-clockwise.
    std::vector<Eigen::Vector3d> hull() const;
    /// Whether a point is within `distance` of a position.
    bool has_point_near(const Eigen::Vector3d& place, double distance) const;
};

/// The planar regions of a scene, and the region of each point. Refers to the scene's positions.
struct PlanarRegions {
    static constexpr std::uint32_t kNone = 0xffffffffU;

    PointTree tree;                       ///< of all points
    std::deque<PlanarRegion> regions;     ///< in descending order of flatness
    std::vector<std::uint32_t> region_of; ///< per point; kNone without a region
    std::vector<double> spacings;         ///< per point: local distance between points

    explicit PlanarRegions(const Scene& scene);
};

/// Finds planar parts of the surface by growing regions from the flattest points (Poppinga,
/// Vaskevicius, Birk & Pathak 2008). The points must be in the order of spatial_sort().
///
/// A point is flat if it and its 12 nearest points are within a seventh of their spacing of a plane
/// (root mean square). From there a region adds the 12 nearest points of each of its points, under
/// two conditions. Their views are in front of the plane, and their distance to it is at most a
/// seventh of the local spacing. The plane is refitted whenever the number of points has doubled.
/// In a dense cloud the distance may be three standard deviations of the noise, if this is more.
/// The noise is the median deviation of a point and its neighbors from a plane. A failed growth of
/// hundreds of points excludes them as seeds, so that noise is not searched repeatedly.
///
/// A slab fits anything with enough points: a slice of noise, or a part of a round surface that
/// bends out of it. Both have many points right beside the slab. So a region needs at least 12
/// points, and four in five of the points around them in a slab three times as thick.
///
/// The result does not depend on the thread count nor, up to rounding, on the position and scale of
/// the scene. Cost: O(points log points + rays), in parallel, and 114 bytes per point plus 4 for
/// each of at most 16 threads.
PlanarRegions planar_regions(const Scene& scene, const Progress& progress,
                             UsualValues* usual = nullptr);

} // namespace vcarve
