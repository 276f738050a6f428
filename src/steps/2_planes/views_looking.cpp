#include "base/parallel.h"
#include "geometry/triangle_tree.h"
#include "steps/2_planes/added_points.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The planar regions as occluders, each as large as the hull of its points.
class Covers {
  public:
    explicit Covers(const PlanarRegions& planes)
        : planes_(planes), owners_(), tree_(triangles_of(planes, owners_))
    {
        Eigen::AlignedBox3d box;
        for (const PlanarRegion& region : planes.regions) {
            for (const Vector3d& position : region.positions) {
                box.extend(position);
            }
        }
        if (!box.isEmpty()) reach_ = 2.0 * box.diagonal().norm();
    }

    /// The planes of the regions above a position of another region.
    std::vector<const Plane*> over(const Vector3d& place, const PlanarRegion& of) const
    {
        constexpr double kClearly = 0.5; // spacings above the plane
        const Vector3d& up = of.plane.normal;
        std::vector<const Plane*> met;
        if (reach_ <= kClearly * of.spacing) return met;
        tree_.visit_met(place + kClearly * of.spacing * up, place + reach_ * up,
                        [&](std::size_t triangle) {
                            const Plane& plane = planes_.regions[owners_[triangle]].plane;
                            if (plane.normal.dot(up) > 0.0) met.push_back(&plane);
                        });
        return met;
    }

  private:
    static std::vector<std::array<Vector3d, 3>> triangles_of(const PlanarRegions& planes,
                                                             std::vector<std::uint32_t>& owners)
    {
        std::vector<std::array<Vector3d, 3>> triangles;
        for (std::uint32_t number = 0; number < planes.regions.size(); ++number) {
            const std::vector<Vector3d> corners = planes.regions[number].hull();
            for (std::size_t i = 2; i < corners.size(); ++i) {
                triangles.push_back({corners[0], corners[i - 1], corners[i]});
                owners.push_back(number);
            }
        }
        return triangles;
    }

    const PlanarRegions& planes_;
    std::vector<std::uint32_t> owners_; ///< region of each triangle
    double reach_ = 0.0;                ///< more than the distance of any two regions
    TriangleTree tree_;
};

/// The points that a view saw, by their direction.
class ShownPoints {
  public:
    ShownPoints(const Scene& scene, std::uint32_t view, std::vector<std::uint32_t> points)
        : center_(scene.views[view].center),
          points_(std::move(points)),
          ways_(points_.size()),
          tree_(ways_of(scene))
    {
    }
    ShownPoints(const ShownPoints&) = delete;
    ShownPoints& operator=(const ShownPoints&) = delete;

    /// The point shown nearest to a position.
    std::uint32_t nearest(const Vector3d& place) const
    {
        thread_local std::vector<PointTree::Near> near;
        tree_.find_nearest((place - center_).normalized(), 1, near);
        return points_[near.front().point];
    }

  private:
    const std::vector<Vector3d>& ways_of(const Scene& scene)
    {
        std::ranges::transform(points_, ways_.begin(), [&](std::uint32_t point) -> Vector3d {
            return (scene.positions[point] - center_).normalized();
        });
        return ways_;
    }

    const Vector3d& center_;
    std::vector<std::uint32_t> points_;
    std::vector<Vector3d> ways_; ///< unit vectors to the points
    PointTree tree_;             ///< of `ways_`
};

/// A view that may look at an accepted point.
struct Question {
    std::uint32_t view;
    std::uint32_t point; ///< index of the accepted point
};

/// The views that may look at textureless points, sorted by view. Clears the tracks of these
/// points.
std::vector<Question> questions(std::vector<AcceptedPoint>& points, const Scene& scene,
                                const PlanarRegions& planes)
{
    const Covers covers(planes);
    const auto ask = [&](std::size_t i, std::vector<Question>& asked) {
        AcceptedPoint& point = points[i];
        if (point.candidate.kind != PointKind::textureless) return;
        const Vector3d& place = point.candidate.position;
        const auto over = covers.over(place, planes.regions[point.candidate.regions[0]]);
        for (const std::uint32_t view : std::exchange(point.track, {})) {
            const auto covered = [&](const Plane* plane) {
                return plane->height_of(scene.views[view].center) > 0.0;
            };
            if (std::ranges::none_of(over, covered))
                asked.push_back({view, static_cast<std::uint32_t>(i)});
        }
    };
    std::vector<Question> asked = parallel_collect<Question>(points.size(), ask, 64);
    std::ranges::stable_sort(asked, {}, &Question::view);
    return asked;
}

} // namespace

void keep_viewing_views(std::vector<AcceptedPoint>& points, const Scene& scene,
                        const PlanarRegions& planes, const Progress& progress)
{
    const std::vector<Question> asked = questions(points, scene, planes);
    std::vector<std::vector<std::uint32_t>> seen(scene.views.size()); // points per view
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            seen[view].push_back(point);
        }
    }
    const auto answer = [&](std::size_t i, std::vector<Question>& yes) {
        const auto view = static_cast<std::uint32_t>(i);
        const auto first = std::ranges::lower_bound(asked, view, {}, &Question::view);
        const auto last = std::ranges::upper_bound(asked, view, {}, &Question::view);
        if (first == last) return;
        const ShownPoints shown(scene, view, std::move(seen[view]));
        std::copy_if(first, last, std::back_inserter(yes), [&](const Question& question) {
            const Candidate& candidate = points[question.point].candidate;
            return planes.region_of[shown.nearest(candidate.position)] == candidate.regions[0];
        });
    };
    for (const auto& [view, point] :
         parallel_collect<Question>(scene.views.size(), progress, answer, 1)) {
        points[point].track.push_back(view);
    }
    std::erase_if(points, [](const AcceptedPoint& point) { return point.track.size() < 2; });
}

} // namespace vcarve
