#include "steps/2_planes/planar_regions.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/scene_points.h"
#include "model/views.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The number of neighbors that define the surface around a point, and the minimum size of a
/// region.
constexpr std::size_t kAround = 12;

/// The least-squares plane of points, and their root mean square distance to it.
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

/// The neighbors of every point, and the surface that they define.
struct Surroundings {
    Neighborhoods neighborhoods;
    std::vector<Vector3d> towards; ///< towards_views() of each point
    std::vector<double> spacings;
    std::vector<double> bends;    ///< root mean square distance to a plane, in spacings, rounded
    double thickness = 1.0 / 7.0; ///< maximum distance to the plane of a region, in spacings

    Surroundings(const Scene& scene, UsualValues* usual, const Progress& progress)
        : neighborhoods(nearest_neighborhoods(scene.positions, kAround, progress.part(0.0, 0.8))),
          towards(scene.num_points()),
          spacings(scene.num_points()),
          bends(scene.num_points())
    {
        parallel_for(bends.size(), progress.part(0.8, 1.0),
                     [&](std::size_t i) { look_around(scene, i); });
        if (!scene.is_dense) return;
        const double bend = usual_value(usual, &UsualValues::bend, [&] { return median_bend(); });
        thickness = std::max(thickness, kOfNoise * bend);
    }

    std::span<const std::uint32_t> around(std::size_t point) const
    {
        return neighborhoods.around(point);
    }

    /// The flat points, the flattest first.
    std::vector<std::uint32_t> flat_points() const
    {
        std::vector<std::uint32_t> flat;
        for (std::uint32_t i = 0; i < bends.size(); ++i) {
            if (bends[i] <= thickness) flat.push_back(i);
        }
        std::ranges::stable_sort(flat, {}, [&](std::uint32_t i) { return bends[i]; });
        return flat;
    }

  private:
    /// Three standard deviations of heights over a plane that was fitted to twelve points.
    static constexpr double kOfNoise = 3.5;

    /// Most points of a dense cloud are on smooth surfaces, so only noise bends them.
    double median_bend() const
    {
        std::vector<double> all = bends;
        return median_in_place(all);
    }

    void look_around(const Scene& scene, std::size_t i)
    {
        std::array<std::uint32_t, kAround + 1> all{static_cast<std::uint32_t>(i)};
        std::ranges::copy(around(i), all.begin() + 1);
        towards[i] = towards_views(scene, i);
        // On a flat surface these points share the disc up to the farthest.
        spacings[i] = std::sqrt(neighborhoods.spacing_sq(i));
        // Rounded, since points without noise differ only in the last digits.
        constexpr double kExact = 1e-3;
        const double bend = fit_plane(scene.positions, all).deviation / spacings[i];
        bends[i] = kExact * std::round(bend / kExact);
    }
};

/// The points that grew from a seed, and their plane and spacing if they are a region.
struct Grown {
    std::vector<std::uint32_t> points;
    std::optional<Plane> plane;
    double spacing = 0.0;
};

/// Grows regions from points without a region. It changes only its marks, so that objects may grow
/// in parallel.
class Growth {
  public:
    Growth(const Scene& scene, const Surroundings& surroundings, const PlanarRegions& found)
        : scene_(scene), surroundings_(surroundings), found_(found), mark_(scene.num_points())
    {
    }

    /// The region around a flat point; empty if the point belongs to a region, and without a plane
    /// if none was found.
    Grown grow(std::uint32_t seed)
    {
        region_.clear();
        if (is_taken(seed)) return {};
        begin(seed);
        for (std::size_t done = 0; done < region_.size();) {
            for (const std::size_t ring = region_.size(); done < ring; ++done) {
                add_around(region_[done]);
            }
            if (region_.size() >= refit_at_) fit();
        }
        Grown grown{region_, std::nullopt};
        if (region_.size() < kAround) return grown;
        std::ranges::sort(region_);
        fit();
        if (has_points_beside()) return grown;
        std::vector<double> spacings = values_at(region_, surroundings_.spacings);
        return {region_, plane_, median_in_place(spacings)};
    }

  private:
    bool is_taken(std::uint32_t point) const
    {
        return found_.region_of[point] != PlanarRegions::kNone;
    }
    bool is_own(std::uint32_t point) const { return mark_[point] == current_; }

    void take_in(std::uint32_t point)
    {
        mark_[point] = current_;
        region_.push_back(point);
    }

    void begin(std::uint32_t seed)
    {
        constexpr double kSparser = 2.0; // times the spacing at the seed
        ++current_;
        take_in(seed);
        plane_.normal = surroundings_.towards[seed];
        set_plane(fit_plane(scene_.positions, surroundings_.around(seed)).plane);
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

    void add_around(std::uint32_t point)
    {
        for (const std::uint32_t other : surroundings_.around(point)) {
            if (!is_own(other) && !is_taken(other) && is_within(other, surroundings_.thickness))
                take_in(other);
        }
    }

    /// Whether a point is at most `spacings` spacings from the plane, and its views are in front of
    /// it.
    bool is_within(std::uint32_t point, double spacings) const
    {
        const double spacing = std::min(surroundings_.spacings[point], most_spacing_);
        return std::abs(plane_.height_of(scene_.positions[point])) <= spacings * spacing &&
               surroundings_.towards[point].dot(plane_.normal) > 0.0;
    }

    /// Whether many points are right beside the slab.
    bool has_points_beside() const
    {
        constexpr double kWider = 3.0;
        constexpr std::size_t kOneIn = 5;
        std::size_t all = 0;
        std::size_t beside = 0;
        for (const std::uint32_t point : region_) {
            for (const std::uint32_t other : surroundings_.around(point)) {
                if (!is_own(other) && !is_within(other, kWider * surroundings_.thickness)) continue;
                ++all;
                beside += is_own(other) ? 0 : 1;
            }
        }
        return kOneIn * beside > all;
    }

    const Scene& scene_;
    const Surroundings& surroundings_;
    const PlanarRegions& found_;
    std::vector<std::uint32_t> mark_; ///< per point: the last growth that added it
    std::uint32_t current_ = 0;
    Plane plane_;
    std::vector<std::uint32_t> region_;
    double most_spacing_ = 0.0;
    std::size_t refit_at_ = 0;
};

/// Grows regions from the seeds as if one after the other. Several grow in parallel, as if none of
/// them took a point. Regions that meet a region added meanwhile grow again.
class GrowthInTurn {
  public:
    GrowthInTurn(const Scene& scene, const Surroundings& surroundings, PlanarRegions& found)
        : scene_(scene), surroundings_(surroundings), found_(found), is_tried_(scene.num_points())
    {
        constexpr std::size_t kMost = 16; // since each marks all points
        for (std::size_t i = 0; i < std::min(num_threads(), kMost); ++i) {
            growths_.emplace_back(scene, surroundings, found);
        }
    }

    void grow(std::span<const std::uint32_t> seeds, const Progress& progress)
    {
        constexpr std::size_t kMostAtOnce = 256; // per thread
        std::size_t at_once = 1;
        ProgressCount done(progress, seeds.size());
        while (!seeds.empty()) {
            const std::size_t count = std::min(seeds.size(), at_once * growths_.size());
            const bool has_added = grow_some(seeds.first(count));
            at_once = has_added ? 1 : std::min(2 * at_once, kMostAtOnce);
            seeds = seeds.subspan(count);
            done.add(count);
        }
    }

  private:
    /// Returns whether a region was added.
    bool grow_some(std::span<const std::uint32_t> seeds)
    {
        std::vector<Grown> grown(seeds.size());
        const auto grow_part = [&](std::size_t part) {
            for (std::size_t i = part; i < seeds.size(); i += growths_.size()) {
                if (is_tried_[seeds[i]] == 0) grown[i] = growths_[part].grow(seeds[i]);
            }
        };
        parallel_for(std::min(seeds.size(), growths_.size()), grow_part, 1);
        const std::size_t before = found_.regions.size();
        for (std::size_t i = 0; i < seeds.size(); ++i) {
            if (is_tried_[seeds[i]] != 0) continue;
            if (meets_since(before, grown[i])) grown[i] = growths_.front().grow(seeds[i]);
            if (grown[i].plane) {
                add(std::move(grown[i]));
            } else if (grown[i].points.size() >= kMany) {
                for (const std::uint32_t point : grown[i].points) {
                    is_tried_[point] = 1;
                }
            }
        }
        return found_.regions.size() > before;
    }

    /// Whether a growth visited a point of a region with a number of at least `regions`.
    bool meets_since(std::size_t regions, const Grown& grown) const
    {
        if (found_.regions.size() == regions) return false;
        const auto is_new = [&](std::uint32_t point) {
            const std::uint32_t region = found_.region_of[point];
            return region != PlanarRegions::kNone && region >= regions;
        };
        return std::ranges::any_of(grown.points, [&](std::uint32_t point) {
            return is_new(point) || std::ranges::any_of(surroundings_.around(point), is_new);
        });
    }

    void add(Grown grown)
    {
        const auto number = static_cast<std::uint32_t>(found_.regions.size());
        for (const std::uint32_t point : grown.points) {
            found_.region_of[point] = number;
        }
        found_.regions.emplace_back(scene_, *grown.plane, grown.spacing, std::move(grown.points));
    }

    static constexpr std::size_t kMany = 256;

    const Scene& scene_;
    const Surroundings& surroundings_;
    PlanarRegions& found_;
    std::deque<Growth> growths_; ///< one per thread
    /// Whether a point belonged to a large growth that is no region. A growth from this point would
    /// be about the same.
    std::vector<std::uint8_t> is_tried_;
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
    std::vector<PointTree::Near> near;
    tree.find_nearest(place, 1, near);
    return near.front().distance <= distance;
}

PlanarRegions::PlanarRegions(const Scene& scene)
    : tree(scene.positions), region_of(scene.num_points(), kNone)
{
}

PlanarRegions planar_regions(const Scene& scene, const Progress& progress, UsualValues* usual)
{
    PlanarRegions found(scene);
    if (scene.num_points() <= kAround) return found;
    const Surroundings surroundings(scene, usual, progress.part(0.0, 0.6));
    GrowthInTurn(scene, surroundings, found)
        .grow(surroundings.flat_points(), progress.part(0.6, 1.0));
    found.spacings = surroundings.spacings;
    return found;
}

} // namespace vcarve
