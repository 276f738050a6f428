#include "io/dense/nearest_rays.h"

#include "base/parallel.h"
#include "geometry/point_order.h"
#include "geometry/point_tree.h"
#include "io/dense/nearest_grid.h"
#include "model/scene_points.h"
#include "model/view_tree.h"
#include "model/views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The number of views tested per point, among those with the point in their image, nearest first.
/// The second batch is for points that got fewer than kMostNearestViews from the first.
constexpr std::array<std::size_t, 2> kAsked{kMostNearestViews, 24};
constexpr std::size_t kMostAtOnce = kAsked.back();
static_assert(kAsked.front() + kAsked.back() == kMostAsked);
/// Up to this number of views, each view gets one grid of all points. With more views, each query
/// makes a grid of the points in its cone.
constexpr std::size_t kFewViews = 64;
/// The point spacing in an image is estimated from this many points, up to twice as many.
constexpr std::size_t kSampled = 8192;
constexpr std::uint32_t kNoView = 0xffffffffU; ///< marks an empty entry

/// A list of at most kMost views; the remaining entries are kNoView.
template <std::size_t kMost>
struct Row {
    std::array<std::uint32_t, kMost> views;
    std::uint32_t count = 0;

    Row() { views.fill(kNoView); }
    void push_back(std::uint32_t view) { views[count++] = view; }
};
using Asked = Row<kMostAtOnce>;
using Seen = Row<kMostNearestViews>;

/// Whether the image size and the center of a view are known.
bool can_show(const Scene& scene, std::size_t view)
{
    const Camera& camera = scene.cameras[scene.views[view].camera];
    return camera.width_px > 0 && camera.height_px > 0 && scene.views[view].center.allFinite();
}

/// Up to `most` views with `place` in their image, nearest first. Skips the nearest `passed` views,
/// and increases `passed` by the number of views tested.
Asked next_views(const Scene& scene, const ViewTree& tree, const Vector3d& place, std::size_t most,
                 std::uint32_t& passed)
{
    Asked row;
    std::uint32_t looked_at = 0;
    tree.any_from_nearest(place, Vector3d::Zero(), [&](std::uint32_t number) {
        if (++looked_at <= passed) return false;
        const View& view = scene.views[number];
        if (can_show(scene, number) && project_into(view, scene.cameras[view.camera], place))
            row.push_back(number);
        return row.count == most;
    });
    passed = looked_at;
    return row;
}

/// Tests which points are hidden from views. The points are in spatial order.
class Hiding {
  public:
    Hiding(const Scene& scene, const std::vector<Vector3d>& places)
        : scene_(scene), places_(places), tree_(places)
    {
        if (scene.views.size() > kFewViews) return;
        whole_.resize(scene.views.size());
        const auto show_all = [&](std::size_t i) {
            if (!can_show(scene, i)) return;
            NearestGrid& grid = whole_[i].emplace(empty_grid(scene.views[i]));
            std::ranges::for_each(places_, [&](const Vector3d& place) { grid.add(place); });
        };
        parallel_for(whole_.size(), show_all, 1);
    }

    /// Calls is_seen(i, sees) for each of `points`: whether view `number` sees it. Cost: O(points
    /// in the cone around `points`, no farther than the farthest of these).
    template <typename IsSeen>
    void ask(std::size_t number, std::span<const std::size_t> points, const IsSeen& is_seen) const
    {
        if (!whole_.empty()) {
            answer(*whole_[number], points, is_seen);
            return;
        }
        const View& view = scene_.views[number];
        NearestGrid grid = empty_grid(view);
        const Cone cone = cone_around(view, points, grid.square_angle());
        const auto bound = [&](const Box& box) { return distance_in(cone, box); };
        tree_.visit_excluding({0, 0}, cone.length, bound,
                              [&](std::size_t i) { grid.add(places_[i]); });
        answer(grid, points, is_seen);
    }

  private:
    NearestGrid empty_grid(const View& view) const
    {
        constexpr std::size_t kDenseStride = 16; // dense points are spaced evenly
        const std::size_t stride = 1 + places_.size() / (2 * kSampled);
        return {view, scene_, places_, scene_.is_dense ? std::max(stride, kDenseStride) : stride};
    }

    template <typename IsSeen>
    void answer(const NearestGrid& grid, std::span<const std::size_t> points,
                const IsSeen& is_seen) const
    {
        for (std::size_t i = 0; i < points.size(); ++i) {
            is_seen(i, grid.sees(places_[points[i]]));
        }
    }

    struct Cone {
        Vector3d tip;
        Vector3d axis;
        double angle;  ///< from the axis to its side
        double length; ///< along its side
    };

    /// The cone around `points` and everything in their squares of the image.
    Cone cone_around(const View& view, std::span<const std::size_t> points, double square) const
    {
        constexpr double kMargin = 4.0; // squares at the image edge may span larger angles
        Cone cone{view.center, Vector3d::Zero(), 0.0, 0.0};
        for (const std::size_t point : points) {
            const Vector3d way = places_[point] - view.center;
            cone.axis += way.stableNormalized();
            cone.length = std::max(cone.length, way.norm());
        }
        cone.axis.stableNormalize();
        double least = 1.0;
        for (const std::size_t point : points) {
            const Vector3d way = places_[point] - view.center;
            least = std::min(least, cone.axis.dot(way.stableNormalized()));
        }
        cone.angle = std::acos(std::max(least, -1.0)) + kMargin * square;
        return cone;
    }

    /// The distance from the tip of a cone to a box; infinite if the box is outside the cone.
    static double distance_in(const Cone& cone, const Box& box)
    {
        const Vector3d middle = 0.5 * (box.low + box.high) - cone.tip;
        const double distance = middle.norm();
        const double radius = 0.5 * (box.high - box.low).norm();
        if (distance > radius) {
            const double off = std::acos(std::clamp(cone.axis.dot(middle) / distance, -1.0, 1.0));
            if (off - std::asin(radius / distance) > cone.angle)
                return std::numeric_limits<double>::infinity();
        }
        return distance_between({cone.tip, cone.tip}, box);
    }

    const Scene& scene_;
    const std::vector<Vector3d>& places_;
    PointTree tree_;
    std::vector<std::optional<NearestGrid>> whole_; ///< the grid of all points, per view
};

/// Finds the rays of points in spatial order, one run of points per call.
class NearestViews {
  public:
    NearestViews(const Scene& scene, const std::vector<Vector3d>& places)
        : scene_(scene), places_(places), views_(scene), hiding_(scene, places)
    {
    }

    /// The views of each point of a run.
    std::vector<Seen> find(const PointRun& run, const Progress& progress) const
    {
        std::vector<Seen> rows(run.size());
        std::vector<std::uint32_t> passed(run.size());
        std::vector<std::uint32_t> left(run.size()); // points of the run that lack views
        std::iota(left.begin(), left.end(), 0U);
        for (const std::size_t most : kAsked) {
            const bool is_first = most == kAsked.front();
            const Progress part = progress.part(is_first ? 0.0 : 0.5, is_first ? 0.5 : 1.0);
            std::vector<Asked> asked(left.size());
            parallel_for(left.size(), part.part(0.0, 0.4), [&](std::size_t i) {
                asked[i] =
                    next_views(scene_, views_, places_[run.first + left[i]], most, passed[left[i]]);
            });
            const std::vector<std::uint8_t> sees =
                ask(run.first, left, questions_of(asked), part.part(0.4, 1.0));
            keep_seen(left, asked, sees, rows);
        }
        return rows;
    }

  private:
    PlacesOfViews questions_of(const std::vector<Asked>& asked) const
    {
        return {asked.size(), scene_.views.size(),
                [&](std::size_t i) { return std::span(asked[i].views).first(asked[i].count); }};
    }

    /// Whether each queried view sees its point. `left` has offsets from the point `first`.
    std::vector<std::uint8_t> ask(std::size_t first, const std::vector<std::uint32_t>& left,
                                  const PlacesOfViews& questions, const Progress& progress) const
    {
        std::vector<std::uint8_t> sees(left.size() * kMostAtOnce);
        const auto ask_view = [&](std::size_t view) {
            const auto of_view = questions.of(view);
            if (of_view.empty()) return;
            std::vector<std::size_t> points(of_view.size());
            std::ranges::transform(of_view, points.begin(),
                                   [&](const auto& place) { return first + left[place.row]; });
            hiding_.ask(view, points, [&](std::size_t i, bool is_seen) {
                sees[of_view[i].row * kMostAtOnce + of_view[i].number] = is_seen ? 1 : 0;
            });
        };
        parallel_for(scene_.views.size(), progress, ask_view, 1);
        return sees;
    }

    /// Adds the views that see the points, and removes points from `left` that cannot get more.
    static void keep_seen(std::vector<std::uint32_t>& left, const std::vector<Asked>& asked,
                          const std::vector<std::uint8_t>& sees, std::vector<Seen>& rows)
    {
        std::size_t kept = 0;
        for (std::size_t i = 0; i < left.size(); ++i) {
            Seen& row = rows[left[i]];
            for (std::size_t k = 0; k < asked[i].count && row.count < kMostNearestViews; ++k) {
                if (sees[i * kMostAtOnce + k] != 0) row.push_back(asked[i].views[k]);
            }
            if (asked[i].count > 0 && row.count < kMostNearestViews) left[kept++] = left[i];
        }
        left.resize(kept);
    }

    const Scene& scene_;
    const std::vector<Vector3d>& places_;
    ViewTree views_;
    Hiding hiding_;
};

/// The finite points, in the order of a Hilbert curve.
std::vector<std::uint32_t> order_of(const std::vector<Vector3d>& positions)
{
    std::vector<std::uint32_t> finite;
    for (std::uint32_t i = 0; i < positions.size(); ++i) {
        if (positions[i].allFinite()) finite.push_back(i);
    }
    return values_at(hilbert_order(values_at(finite, positions)), finite);
}

} // namespace

Tracks nearest_rays(const Scene& scene, const Progress& progress)
{
    const std::vector<std::uint32_t> order = order_of(scene.positions);
    const std::vector<Vector3d> places = values_at(order, scene.positions);
    std::vector<Seen> rows(scene.num_points());
    if (!places.empty()) {
        constexpr std::size_t kAtOnce = std::size_t{1} << 18U; // limits the memory of the queries
        const NearestViews nearest(scene, places);
        const auto share = [&](std::size_t point) {
            return static_cast<double>(point) / static_cast<double>(places.size());
        };
        for (std::size_t first = 0; first < places.size(); first += kAtOnce) {
            const PointRun run{first, std::min(places.size(), first + kAtOnce)};
            const std::vector<Seen> found =
                nearest.find(run, progress.part(share(run.first), share(run.last)));
            for (std::size_t i = 0; i < run.size(); ++i) {
                Seen& row = rows[order[run.first + i]];
                row = found[i];
                std::ranges::sort(row.views); // empty entries sort last
            }
        }
    }
    return make_tracks(
        rows.size(), [&](std::size_t i) { return std::span(rows[i].views).first(rows[i].count); });
}

} // namespace vcarve
