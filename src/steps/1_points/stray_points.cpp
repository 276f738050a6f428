#include "steps/1_points/stray_points.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "geometry/point_tree.h"
#include "model/scene_points.h"
#include "model/views.h"

#include <algorithm>
#include <array>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// More than the number of false matches that may occur close to each other.
constexpr std::size_t kCrowd = 4;

/// The points with few enough views to be stray.
std::vector<std::uint32_t> seldom_seen_points(const Scene& scene)
{
    constexpr std::size_t kFew = 2;
    return parallel_collect<std::uint32_t>(scene.num_points(), [&](std::size_t i, auto& found) {
        const auto track = scene.tracks[i];
        if (track.size() <= kFew && !has_measured_range(scene, track))
            found.push_back(static_cast<std::uint32_t>(i));
    });
}

/// Evenly spread points for estimating medians; all points if they are few.
std::vector<std::uint32_t> spread_sample(const Scene& scene)
{
    constexpr std::size_t kEnough = 8192;
    const std::size_t stride = 1 + scene.num_points() / kEnough;
    std::vector<std::uint32_t> sample;
    for (std::size_t point = 0; point < scene.num_points(); point += stride) {
        sample.push_back(static_cast<std::uint32_t>(point));
    }
    return sample;
}

/// The isolation of points: the distance to the 4th nearest other point, over the distance to the
/// nearest view that saw the point.
class Solitude {
  public:
    explicit Solitude(const Scene& scene) : scene_(scene), tree_(scene.positions) {}

    /// Whether the isolation of a point is at least `solitude`.
    bool is_at_least(double solitude, std::size_t point) const
    {
        const double distance = solitude * distance_to_views(point);
        return !has_crowd_along(point, distance) && reach(point, distance) >= distance;
    }

    /// The median isolation of some points.
    double median(const std::vector<std::uint32_t>& points) const
    {
        std::vector<double> all(points.size());
        const auto look = [&](std::size_t i) {
            all[i] = reach(points[i], kUnlimited) / distance_to_views(points[i]);
        };
        parallel_for(all.size(), look, 64);
        return median_in_place(all);
    }

  private:
    double distance_to_views(std::size_t point) const
    {
        double nearest = kUnlimited;
        for (const std::uint32_t view : scene_.tracks[point]) {
            nearest = std::min(nearest, (scene_.views[view].center - place(point)).norm());
        }
        return nearest;
    }

    /// Whether four of the points just before or after it in the order are closer than `distance`.
    /// Most points pass this quick test, and need no search.
    bool has_crowd_along(std::size_t point, double distance) const
    {
        constexpr std::size_t kSome = 4;
        const std::size_t first = point - std::min(point, kSome);
        const std::size_t last = std::min(scene_.num_points(), point + kSome + 1);
        std::size_t num_near = 0;
        for (std::size_t other = first; other < last; ++other) {
            if (other != point && (place(other) - place(point)).norm() < distance) ++num_near;
        }
        return num_near >= kCrowd;
    }

    /// The distance to the 4th nearest other point, at most `most`.
    double reach(std::size_t point, double most) const
    {
        std::array<double, kCrowd> nearest;
        nearest.fill(most);
        const auto look_at = [&](std::size_t other) {
            const double distance = (place(other) - place(point)).norm();
            if (!(distance < nearest.back())) return;
            nearest.back() = distance;
            std::ranges::sort(nearest);
        };
        tree_.visit_near(place(point), {point, point + 1}, nearest.back(), look_at);
        return nearest.back();
    }

    const Vector3d& place(std::size_t point) const { return scene_.positions[point]; }

    const Scene& scene_;
    PointTree tree_;
};

/// Typical reprojection errors. If none is known, no error is below or above them.
struct UsualErrors {
    double median = 0.0;
    double large = kUnlimited; ///< one error in twenty is larger
};

UsualErrors usual_errors(const Scene& scene, const std::vector<std::uint32_t>& points)
{
    constexpr std::size_t kWorst = 20; // one in this number is large
    std::vector<double> errors;
    for (const std::uint32_t point : points) {
        if (scene.errors_px[point] >= 0.0) errors.push_back(scene.errors_px[point]);
    }
    if (errors.empty()) return {};
    std::ranges::sort(errors);
    return {errors[errors.size() / 2], errors[errors.size() - 1 - errors.size() / kWorst]};
}

/// The factor of the limit `stray_spacing` that a reprojection error causes.
double tolerance(double error_px, const UsualErrors& usual)
{
    constexpr double kOfLargeError = 2.0 / 3.0;
    constexpr double kOfSmallError = 1.75;
    if (error_px > usual.large) return kOfLargeError;
    return error_px >= 0.0 && error_px < usual.median ? kOfSmallError : 1.0;
}

/// Drops some points, given in ascending order.
void drop_points(Scene& scene, const std::vector<std::uint32_t>& dropped)
{
    const auto kept =
        parallel_collect<std::uint32_t>(scene.num_points(), [&](std::size_t i, auto& found) {
            const auto point = static_cast<std::uint32_t>(i);
            if (!std::ranges::binary_search(dropped, point)) found.push_back(point);
        });
    const auto track_of = [&](std::size_t i) { return scene.tracks[kept[i]]; };
    keep_points(scene, kept, make_tracks(kept.size(), track_of));
}

} // namespace

std::int64_t drop_stray_points(Scene& scene, const FilterOptions& options, UsualValues* values)
{
    if (options.stray_spacing == 0.0 || scene.num_points() <= kCrowd) return 0;
    const std::vector<std::uint32_t> candidates = seldom_seen_points(scene);
    if (candidates.empty()) return 0;
    const Solitude solitude(scene);
    const std::vector<std::uint32_t> usual = spread_sample(scene);
    const double median =
        usual_value(values, &UsualValues::isolation, [&] { return solitude.median(usual); });
    const double most = options.stray_spacing * median;
    if (!(most > 0.0)) return 0; // no view saw half of them
    UsualErrors errors = usual_errors(scene, usual);
    errors.median = usual_value(values, &UsualValues::error_px, [&] { return errors.median; });
    errors.large = usual_value(values, &UsualValues::large_error_px, [&] { return errors.large; });
    const auto is_stray = [&](std::uint32_t point) {
        return solitude.is_at_least(tolerance(scene.errors_px[point], errors) * most, point);
    };
    const auto stray = parallel_collect<std::uint32_t>(
        candidates.size(),
        [&](std::size_t i, auto& found) {
            if (is_stray(candidates[i])) found.push_back(candidates[i]);
        },
        64);
    if (!stray.empty()) drop_points(scene, stray);
    return static_cast<std::int64_t>(stray.size());
}

} // namespace vcarve
