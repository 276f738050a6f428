#include "io/dense/nearest_sights.h"

#include "base/parallel.h"
#include "model/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr float kNothing = std::numeric_limits<float>::infinity();
/// How steep a surface may stand before a view: by how much more the distance of its points differs
/// than they lie apart across the sights.
constexpr double kSteepest = 2.0;
/// What depths are off by, as a share of the distance, where squares are small.
constexpr double kLeastNearer = 0.01;
/// Squares of the grid are so many times as wide as points stand apart in the image on average.
constexpr double kSquareWidth = 2.0;
/// The same of sparse points, in the part of the image that has any: they gather where there is
/// texture, and leave gaps elsewhere.
constexpr double kSparseSquareWidth = 4.0;
/// The points of which every so many are counted to find how far they stand apart.
constexpr std::size_t kSampled = 16;

/// Where a point is in an image, and how far from its view.
struct Projected {
    Vector2d place_px;
    float distance = 0.0F;
};

/// The least distances that a view finds in squares of its image.
class NearestGrid {
  public:
    NearestGrid(const View& view, const Scene& scene)
        : view_(view), camera_(scene.cameras[view.camera])
    {
        choose_squares(scene);
        for (const Vector3d& position : scene.positions) {
            const auto projected = project_to(position);
            if (!projected) continue;
            float& nearest = least_[square_of(projected->place_px)];
            nearest = std::min(nearest, projected->distance);
        }
    }

    /// Whether the point is in the image, and no other is clearly before it.
    bool sees(const Vector3d& position) const
    {
        const auto projected = project_to(position);
        if (!projected) return false;
        return least_[square_of(projected->place_px)] >= projected->distance * hides_from_;
    }

  private:
    std::optional<Projected> project_to(const Vector3d& position) const
    {
        const Vector3d in_camera = view_.cam_from_world * (position - view_.center);
        if (!in_camera.allFinite() || !image_shows(camera_, in_camera)) return std::nullopt;
        const auto place_px = project(camera_, in_camera);
        if (!place_px) return std::nullopt;
        return Projected{*place_px, static_cast<float>(in_camera.norm())};
    }

    void choose_squares(const Scene& scene)
    {
        std::size_t shown = 1;
        for (std::size_t i = 0; i < scene.num_points(); i += kSampled) {
            if (project_to(scene.positions[i])) shown += kSampled;
        }
        const auto count = static_cast<double>(shown);
        lay_squares(kSquareWidth, 1.0, count);
        if (scene.is_dense) return;
        constexpr float kTaken = 0.0F;
        for (const Vector3d& position : scene.positions) {
            const auto projected = project_to(position);
            if (projected) least_[square_of(projected->place_px)] = kTaken;
        }
        const auto taken = static_cast<double>(std::ranges::count(least_, kTaken));
        lay_squares(kSparseSquareWidth, taken / static_cast<double>(least_.size()), count);
    }

    /// Empty ones, so many times as wide as so many points stand apart in a share of the image.
    void lay_squares(double width, double share, double count)
    {
        const auto width_px = static_cast<double>(camera_.width_px);
        const auto height_px = static_cast<double>(camera_.height_px);
        // At most as many squares along an edge as points, whatever size an image claims to have.
        square_px_ = std::max(width * std::sqrt(share * width_px * height_px / count),
                              std::max(width_px, height_px) / count);
        columns_ = static_cast<std::size_t>(width_px / square_px_) + 1;
        rows_ = static_cast<std::size_t>(height_px / square_px_) + 1;
        least_.assign(columns_ * rows_, kNothing);
        const double nearer = std::max(kLeastNearer, kSteepest * square_px_ * radians_a_pixel());
        hides_from_ = static_cast<float>(1.0 - nearer);
    }

    /// In the middle of the image; zero where its camera shows no direction there.
    double radians_a_pixel() const
    {
        const Vector2d middle(0.5 * static_cast<double>(camera_.width_px),
                              0.5 * static_cast<double>(camera_.height_px));
        const auto ahead = ray(camera_, middle);
        const auto beside = ray(camera_, middle + Vector2d::UnitX());
        return ahead && beside ? (*ahead - *beside).norm() : 0.0;
    }

    std::size_t square_of(const Vector2d& place_px) const
    {
        const auto index = [&](double place, std::size_t count) {
            const double last = static_cast<double>(count) - 1.0;
            return static_cast<std::size_t>(std::clamp(place / square_px_, 0.0, last));
        };
        return index(place_px.y(), rows_) * columns_ + index(place_px.x(), columns_);
    }

    const View& view_;
    const Camera& camera_;
    double square_px_ = 1.0;
    float hides_from_ = 1.0F; ///< of a point's distance: what is nearer hides it
    std::size_t columns_ = 1;
    std::size_t rows_ = 1;
    std::vector<float> least_; ///< of each square, row by row
};

/// A camera whose lens or image is not known shows nothing that could be told.
bool can_show(const Camera& camera)
{
    return camera.width_px > 0 && camera.height_px > 0;
}

constexpr std::uint32_t kNoView = 0xffffffffU; ///< stands in a place that is left

/// The views of a point, ascending; the rest of the places stay empty.
struct Row {
    std::array<std::uint32_t, kMostNearestViews> views;
    std::uint32_t count = 0;
};

class NearestViews {
  public:
    NearestViews(const Scene& scene, const Progress& progress) : scene_(scene)
    {
        grids_.resize(scene.views.size());
        const auto make = [&](std::size_t i) {
            const Camera& camera = scene.cameras[scene.views[i].camera];
            if (can_show(camera)) grids_[i].emplace(scene.views[i], scene);
        };
        parallel_for(grids_.size(), progress, make, 1);
    }

    /// `order` is what the views are sorted in, and empty.
    Row of_point(std::size_t point, std::vector<std::pair<double, std::uint32_t>>& order) const
    {
        Row row;
        row.views.fill(kNoView);
        const Vector3d& position = scene_.positions[point];
        if (!position.allFinite()) return row;
        for (std::uint32_t view = 0; view < scene_.views.size(); ++view) {
            if (grids_[view]) {
                order.emplace_back((scene_.views[view].center - position).squaredNorm(), view);
            }
        }
        std::ranges::make_heap(order, std::greater<>());
        while (!order.empty() && row.count < kMostNearestViews) {
            const std::uint32_t view = order.front().second;
            if (grids_[view]->sees(position)) row.views[row.count++] = view;
            std::ranges::pop_heap(order, std::greater<>());
            order.pop_back();
        }
        std::ranges::sort(row.views); // those that are left come last
        return row;
    }

  private:
    const Scene& scene_;
    std::vector<std::optional<NearestGrid>> grids_; ///< a view
};

} // namespace

Tracks nearest_sights(const Scene& scene, const Progress& progress)
{
    using Order = std::pair<double, std::uint32_t>;
    const NearestViews nearest(scene, progress.part(0.0, 0.5));
    const Progress second = progress.part(0.5, 1.0);
    std::vector<Row> rows(scene.num_points());
    const auto find_range = [&](std::size_t first, std::size_t last) {
        std::vector<Order> order;
        for (std::size_t point = first; point != last; ++point) {
            order.clear();
            rows[point] = nearest.of_point(point, order);
        }
    };
    parallel_for_ranges(rows.size(), second, find_range);
    Tracks tracks;
    tracks.begins.reserve(rows.size() + 1);
    for (const Row& row : rows) {
        tracks.push_back(std::span(row.views).first(row.count));
    }
    return tracks;
}

} // namespace vcarve
