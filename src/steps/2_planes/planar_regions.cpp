#include "steps/2_planes/planar_regions.h"

#include "base/median.h"
#include "base/parallel.h"
#include "model/scene_points.h"
#include "model/towards_views.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// How many points around a point tell how the surface runs there, and how many make a region.
constexpr std::size_t kAround = 12;
/// How far from its plane a point of a region may lie, in spacings.
constexpr double kThickness = 1.0 / 7.0;
using Around = std::array<std::uint32_t, kAround>;

/// The plane that lies nearest to points, and how far from it they lie: the root of the mean
/// square.
struct FittedPlane {
    Plane plane;
    double deviation = 0.0;
};

FittedPlane fit_plane(const std::vector<Vector3d>& positions, std::span<const std::uint32_t> points)
{
    const auto count = static_cast<double>(points.size());
    Vector3d mean = Vector3d::Zero();
    for (const std::uint32_t point : points) {
        mean += positions[point];
    }
    mean /= count;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const std::uint32_t point : points) {
        spread += (positions[point] - mean) * (positions[point] - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread / count);
    return {{mean, solver.eigenvectors().col(0)},
            std::sqrt(std::max(solver.eigenvalues()[0], 0.0))};
}

/// The points around every point, and what they tell.
struct Surroundings {
    std::vector<Around> around;
    std::vector<double> spacings;
    std::vector<double> bends; ///< how far they lie from a plane, in spacings, rounded

    Surroundings(const Scene& scene, const NearestNeighbors& tree, const Progress& progress)
        : around(scene.num_points()), spacings(scene.num_points()), bends(scene.num_points())
    {
        parallel_for(around.size(), progress,
                     [&](std::size_t i) { look_around(scene.positions, tree, i); });
    }

    /// The flat points, the flattest first.
    std::vector<std::uint32_t> flat_points() const
    {
        std::vector<std::uint32_t> flat;
        for (std::uint32_t i = 0; i < bends.size(); ++i) {
            if (bends[i] <= kThickness) flat.push_back(i);
        }
        std::ranges::stable_sort(flat, {}, [&](std::uint32_t i) { return bends[i]; });
        return flat;
    }

  private:
    void look_around(const std::vector<Vector3d>& positions, const NearestNeighbors& tree,
                     std::size_t i)
    {
        thread_local std::vector<NearestNeighbors::Neighbor> nearest;
        tree.find(positions[i], kAround + 1, nearest); // the point, too
        std::array<std::uint32_t, kAround + 1> all{};
        std::ranges::transform(nearest, all.begin(), &NearestNeighbors::Neighbor::point);
        std::ranges::copy(std::span(all).subspan<1>(), around[i].begin());
        // Where the surface is flat, so many points share the disc out to the farthest.
        spacings[i] = std::sqrt(nearest.back().distance_sq * std::numbers::pi / kAround);
        // Rounded, since points without noise are flat but for the last digits.
        constexpr double kExact = 1e-3;
        const double bend = fit_plane(positions, all).deviation / spacings[i];
        bends[i] = kExact * std::round(bend / kExact);
    }
};

/// Grows one region after the other.
class Growth {
  public:
    Growth(const Scene& scene, const Surroundings& surroundings, PlanarRegions& found)
        : scene_(scene), surroundings_(surroundings), found_(found)
    {
    }

    /// Adds the region around a flat point, unless that is another's or there is none.
    void grow(std::uint32_t seed)
    {
        if (found_.region_of[seed] != PlanarRegions::kNone) return;
        begin(seed);
        for (std::size_t done = 0; done < region_.size();) {
            for (const std::size_t ring = region_.size(); done < ring; ++done) {
                take_in_around(region_[done]);
            }
            if (region_.size() >= refit_at_) fit();
        }
        if (region_.size() >= kAround && add_if_planar()) return;
        for (const std::uint32_t point : region_) {
            found_.region_of[point] = PlanarRegions::kNone;
        }
    }

  private:
    std::uint32_t number() const { return static_cast<std::uint32_t>(found_.regions.size()); }

    void begin(std::uint32_t seed)
    {
        constexpr double kSparser = 2.0; // than at the seed
        region_ = {seed};
        found_.region_of[seed] = number();
        plane_.normal = towards_views(scene_, seed);
        set_plane(fit_plane(scene_.positions, surroundings_.around[seed]).plane);
        plane_.center = scene_.positions[seed];
        most_spacing_ = kSparser * surroundings_.spacings[seed];
        refit_at_ = 2 * kAround;
    }

    void fit()
    {
        set_plane(fit_plane(scene_.positions, region_).plane);
        refit_at_ = 2 * region_.size();
    }

    void set_plane(Plane plane)
    {
        if (plane.normal.dot(plane_.normal) < 0.0) plane.normal = -plane.normal;
        plane_ = plane;
    }

    void take_in_around(std::uint32_t point)
    {
        for (const std::uint32_t other : surroundings_.around[point]) {
            if (found_.region_of[other] != PlanarRegions::kNone || !is_within(other, kThickness))
                continue;
            found_.region_of[other] = number();
            region_.push_back(other);
        }
    }

    /// Whether a point lies so many spacings from the plane at most, and is looked at from the same
    /// side.
    bool is_within(std::uint32_t point, double spacings) const
    {
        const double spacing = std::min(surroundings_.spacings[point], most_spacing_);
        return std::abs(plane_.height_of(scene_.positions[point])) <= spacings * spacing &&
               towards_views(scene_, point).dot(plane_.normal) > 0.0;
    }

    bool add_if_planar()
    {
        std::ranges::sort(region_);
        fit();
        if (goes_on_beside()) return false;
        std::vector<double> spacings = values_at(region_, surroundings_.spacings);
        found_.regions.emplace_back(scene_, plane_, median_in_place(spacings), region_);
        return true;
    }

    /// Whether many points lie right beside the slab.
    bool goes_on_beside() const
    {
        constexpr double kWider = 3.0;
        constexpr std::size_t kOneIn = 5;
        std::size_t all = 0;
        std::size_t beside = 0;
        for (const std::uint32_t point : region_) {
            for (const std::uint32_t other : surroundings_.around[point]) {
                const bool is_own = found_.region_of[other] == number();
                if (!is_own && !is_within(other, kWider * kThickness)) continue;
                ++all;
                beside += is_own ? 0 : 1;
            }
        }
        return kOneIn * beside > all;
    }

    const Scene& scene_;
    const Surroundings& surroundings_;
    PlanarRegions& found_;
    Plane plane_;
    std::vector<std::uint32_t> region_;
    double most_spacing_ = 0.0;
    std::size_t refit_at_ = 0;
};

} // namespace

PlanarRegion::PlanarRegion(const Scene& scene, const Plane& fitted, double median_spacing,
                           std::vector<std::uint32_t> of)
    : plane(fitted),
      spacing(median_spacing),
      points(std::move(of)),
      positions(values_at(points, scene.positions)),
      tree(positions)
{
}

std::vector<std::uint32_t> PlanarRegion::nearest(const Vector3d& place, std::size_t count) const
{
    constexpr std::size_t kEqual = 4;
    std::vector<PointTree::Near> near;
    tree.find_nearest(place, count + kEqual, near);
    const double most = near[std::min(count, near.size()) - 1].distance + kRounding * spacing;
    std::vector<std::uint32_t> found;
    for (const PointTree::Near& point : near) {
        if (point.distance <= most) found.push_back(points[point.point]);
    }
    return found;
}

std::vector<Vector3d> PlanarRegion::hull() const
{
    using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;
    const PlaneFrame frame(plane);
    std::vector<Point> places(positions.size());
    std::ranges::transform(positions, places.begin(), [&](const Vector3d& position) {
        const Eigen::Vector2d at = frame.in_plane(position);
        return Point(at.x(), at.y());
    });
    std::vector<Point> corners;
    CGAL::convex_hull_2(places.begin(), places.end(), std::back_inserter(corners));
    std::vector<Vector3d> hull(corners.size());
    std::ranges::transform(corners, hull.begin(), [&](const Point& corner) {
        return frame.in_space({corner.x(), corner.y()});
    });
    return hull;
}

bool PlanarRegion::has_point_near(const Vector3d& place, double distance) const
{
    constexpr double kDone = -1.0; // no box is so near
    double most = distance;
    tree.visit_near(place, {0, 0}, most, [&](std::size_t i) {
        if ((positions[i] - place).norm() <= distance) most = kDone;
    });
    return most == kDone;
}

PlanarRegions::PlanarRegions(const Scene& scene)
    : tree(scene.positions), region_of(scene.num_points(), kNone)
{
}

PlanarRegions planar_regions(const Scene& scene, const Progress& progress)
{
    PlanarRegions found(scene);
    if (scene.num_points() <= kAround) return found;
    const Surroundings surroundings(scene, found.tree, progress.part(0.0, 0.6));
    Growth growth(scene, surroundings, found);
    const std::vector<std::uint32_t> seeds = surroundings.flat_points();
    ProgressCount done(progress.part(0.6, 1.0), seeds.size());
    for (const std::uint32_t seed : seeds) {
        growth.grow(seed);
        done.add(1);
    }
    found.spacings = surroundings.spacings;
    return found;
}

} // namespace vcarve
