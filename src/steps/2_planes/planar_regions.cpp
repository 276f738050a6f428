#include "steps/2_planes/planar_regions.h"

#include "base/median.h"
#include "base/parallel.h"
#include "model/scene_points.h"
#include "model/towards_views.h"

#include <CGAL/Shape_detection/Region_growing/Region_growing.h>
#include <CGAL/property_map.h>
#include <Eigen/Eigenvalues>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <array>
#include <cmath>
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

/// CGAL's word for no point.
constexpr auto kNone = static_cast<std::size_t>(-1);

using Around = std::array<std::uint32_t, kAround>;

/// The plane that lies nearest to points, and how far from it they lie: the root of the mean
/// square.
struct FittedPlane {
    Plane plane;
    double deviation = 0.0;
};

template <typename Points>
FittedPlane fit_plane(const std::vector<Vector3d>& positions, const Points& points)
{
    const auto count = static_cast<double>(std::size(points));
    Vector3d mean = Vector3d::Zero();
    for (const auto point : points) {
        mean += positions[point];
    }
    mean /= count;
    Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
    for (const auto point : points) {
        spread += (positions[point] - mean) * (positions[point] - mean).transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread / count);
    return {{mean, solver.eigenvectors().col(0)},
            std::sqrt(std::max(solver.eigenvalues()[0], 0.0))};
}

/// The largest angle between directions from a point in a plane to others that follow each other
/// around it.
double largest_gap(const std::vector<Vector3d>& positions, std::size_t point, const Around& around,
                   const Vector3d& normal)
{
    const Vector3d x = normal.unitOrthogonal();
    const Vector3d y = normal.cross(x);
    std::array<double, kAround> angles{};
    std::ranges::transform(around, angles.begin(), [&](std::uint32_t other) {
        const Vector3d way = positions[other] - positions[point];
        return std::atan2(y.dot(way), x.dot(way));
    });
    std::ranges::sort(angles);
    double largest = angles.front() + 2.0 * std::numbers::pi - angles.back();
    for (std::size_t i = 1; i < angles.size(); ++i) {
        largest = std::max(largest, angles[i] - angles[i - 1]);
    }
    return largest;
}

/// The points around every point, and what they tell.
struct Surroundings {
    std::vector<Around> around;
    std::vector<double> spacings;
    std::vector<double> bends; ///< how far they lie from a plane, in spacings, rounded
    std::vector<char> is_one_sided;

    Surroundings(const Scene& scene, const NearestNeighbors& tree, const Progress& progress)
        : around(scene.num_points()),
          spacings(scene.num_points()),
          bends(scene.num_points()),
          is_one_sided(scene.num_points())
    {
        parallel_for(around.size(), progress,
                     [&](std::size_t i) { look_around(scene.positions, tree, i); });
    }

    /// The points to grow regions from, the flattest first; for each that is bent too much kNone.
    std::vector<std::size_t> seeds() const
    {
        std::vector<std::size_t> seeds;
        for (std::size_t i = 0; i < bends.size(); ++i) {
            if (bends[i] <= kThickness) seeds.push_back(i);
        }
        std::ranges::stable_sort(seeds, {}, [&](std::size_t i) { return bends[i]; });
        seeds.resize(bends.size(), kNone);
        return seeds;
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
        const FittedPlane fitted = fit_plane(positions, all);
        bends[i] = kExact * std::round(fitted.deviation / spacings[i] / kExact);
        constexpr double kOneSided = std::numbers::pi * 150.0 / 180.0;
        is_one_sided[i] = static_cast<char>(
            largest_gap(positions, i, around[i], fitted.plane.normal) > kOneSided);
    }
};

/// What CGAL asks for the neighbours of a point.
class Neighbors {
  public:
    explicit Neighbors(const std::vector<Around>& around) : around_(around) {}

    void operator()(std::size_t point, std::vector<std::size_t>& neighbors) const
    {
        neighbors.assign(around_[point].begin(), around_[point].end());
    }

  private:
    const std::vector<Around>& around_;
};

/// What CGAL asks which points belong to a region.
class FlatRegion {
  public:
    FlatRegion(const Scene& scene, const Surroundings& surroundings, const Progress& progress)
        : scene_(scene), surroundings_(surroundings), progress_(progress)
    {
    }

    bool is_part_of_region(std::size_t /*from*/, std::size_t point,
                           const std::vector<std::size_t>& /*region*/) const
    {
        const double spacing = std::min(surroundings_.spacings[point], most_spacing_);
        const double height = plane_.normal.dot(scene_.positions[point] - plane_.center);
        return std::abs(height) <= kThickness * spacing &&
               towards_views(scene_, point).dot(plane_.normal) > 0.0;
    }

    static bool is_valid_region(const std::vector<std::size_t>& region)
    {
        return region.size() >= kAround;
    }

    /// Called with the seed alone, then whenever all that was found has been looked around.
    void update(const std::vector<std::size_t>& region)
    {
        if (region.size() == 1) {
            begin(region.front());
        } else if (region.size() >= refit_at_) {
            set_plane(fit_plane(scene_.positions, region).plane);
            refit_at_ = 2 * region.size();
        }
    }

    const Plane& plane() const { return plane_; }

    void set_plane(Plane plane)
    {
        if (plane.normal.dot(plane_.normal) < 0.0) plane.normal = -plane.normal;
        plane_ = plane;
    }

  private:
    void begin(std::size_t seed)
    {
        constexpr double kSparser = 2.0; // than at the seed
        progress_.tell(0.0);
        plane_.normal = towards_views(scene_, seed);
        set_plane(fit_plane(scene_.positions, surroundings_.around[seed]).plane);
        plane_.center = scene_.positions[seed];
        most_spacing_ = kSparser * surroundings_.spacings[seed];
        refit_at_ = 2 * kAround;
    }

    const Scene& scene_;
    const Surroundings& surroundings_;
    Progress progress_;
    Plane plane_;
    double most_spacing_ = 0.0;
    std::size_t refit_at_ = 0;
};

} // namespace

PlanarRegions planar_regions(const Scene& scene, const NearestNeighbors& tree,
                             const Progress& progress)
{
    PlanarRegions found;
    if (scene.num_points() <= kAround) return found;
    Surroundings surroundings(scene, tree, progress.part(0.0, 0.6));
    const std::vector<std::size_t> seeds = surroundings.seeds();
    Neighbors neighbors(surroundings.around);
    FlatRegion flat(scene, surroundings, progress.part(0.6, 1.0));
    CGAL::Shape_detection::Region_growing growing(scene.positions, neighbors, flat,
                                                  CGAL::make_property_map(seeds));
    growing.detect(boost::make_function_output_iterator([&](std::vector<std::size_t> points) {
        std::ranges::sort(points);
        flat.set_plane(fit_plane(scene.positions, points).plane);
        std::vector<double> spacings = values_at(points, surroundings.spacings);
        found.regions.push_back(
            {flat.plane(), median_in_place(spacings), {points.begin(), points.end()}});
    }));
    found.spacings = std::move(surroundings.spacings);
    found.is_one_sided = std::move(surroundings.is_one_sided);
    return found;
}

} // namespace vcarve
