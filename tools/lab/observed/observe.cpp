#include "observed/observe.h"

#include "model/camera.h"
#include "observed/onlookers.h"
#include "random.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace vcarve::observed {

namespace {

using bench::Random;
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kNoisePx = 0.7;
constexpr double kFalse = 1.0 / 100.0;
constexpr double kFoundAgain = 2.0 / 3.0;

/// The pixels of a point in one or more views.
struct Match {
    std::vector<std::uint32_t> views; ///< ascending
    std::vector<Vector2d> places_px;  ///< one per view
};

/// Finds matches in the images of a scene, and triangulates them.
class Matcher {
  public:
    explicit Matcher(const ObservedScene& observed)
        : onlookers_(observed),
          views_(onlookers_.views()),
          spots_(observed.parts, Spread::area_and_contrast)
    {
        model_.scene.cameras = {onlookers_.camera()};
        model_.scene.views = views_;
        model_.observations.resize(views_.size());
    }

    void add_point(Random& random)
    {
        const Spot spot = spots_.draw(random);
        std::vector<std::uint32_t> seeing = onlookers_.seeing(spot);
        if (seeing.size() < 2) return;
        const std::uint32_t first = seeing[random.below(seeing.size())];
        const bool is_false = random.uniform() < kFalse;
        is_false ? add_false_match(spot, first, random) : add_match(spot, first, seeing, random);
    }

    std::size_t num_points() const { return model_.scene.num_points(); }
    ObservedModel take() { return std::move(model_); }

  private:
    void add_match(const Spot& spot, std::uint32_t first, const std::vector<std::uint32_t>& seeing,
                   Random& random)
    {
        static const double least_cosine = std::cos(35.0 * kDegree);
        const auto towards = [&](std::uint32_t view) -> Vector3d {
            return (views_[view].center - spot.position).normalized();
        };
        Match match;
        for (const std::uint32_t view : seeing) {
            const bool alike = towards(view).dot(towards(first)) >= least_cosine;
            if (view == first || (random.uniform() < kFoundAgain && alike))
                add_to(match, view, spot.position, random);
        }
        const Vector3d position = best_fit(match, spot.position);
        if (is_good(match, position)) add(match, position, spot.paint);
    }

    /// Adds a point on the ray of a view, seen by this view and up to two more.
    void add_false_match(const Spot& spot, std::uint32_t first, Random& random)
    {
        const double share = 0.5 * std::pow(3.0, random.uniform()); // 0.5 to 1.5 of the depth
        const Vector3d& center = views_[first].center;
        const Vector3d position = center + share * (spot.position - center);
        Match match;
        std::size_t others = 1 + random.below(2);
        for (std::uint32_t view = 0; view < views_.size(); ++view) {
            const bool joins = view == first || (others > 0 && random.uniform() < 0.2);
            if (!joins || !view_shows(views_[view], onlookers_.camera(), position)) continue;
            if (view != first) --others;
            add_to(match, view, position, random);
        }
        const Vector3d fitted = best_fit(match, position);
        if (is_good(match, fitted)) add(match, fitted, spot.paint);
    }

    void add_to(Match& match, std::uint32_t view, const Vector3d& position, Random& random) const
    {
        const double x = random.normal();
        const Vector2d noise(kNoisePx * x, kNoisePx * random.normal());
        match.views.push_back(view);
        match.places_px.push_back(*onlookers_.place_px(view, position) + noise);
    }

    /// Minimizes the sum of squared reprojection errors (Gauss and Newton).
    Vector3d best_fit(const Match& match, Vector3d position) const
    {
        constexpr int kSteps = 8;
        const Vector2d focal_px(onlookers_.camera().params[0], onlookers_.camera().params[1]);
        for (int step = 0; step < kSteps && match.views.size() > 1; ++step) {
            Eigen::Matrix3d normal_matrix = Eigen::Matrix3d::Zero();
            Vector3d right_side = Vector3d::Zero();
            for (std::size_t i = 0; i < match.views.size(); ++i) {
                const std::uint32_t view = match.views[i];
                const Vector3d x = onlookers_.in_camera(view, position);
                const auto place = onlookers_.place_px(view, position);
                if (!place) return position;
                Eigen::Matrix<double, 2, 3> slope;
                slope << focal_px.x() / x.z(), 0.0, -focal_px.x() * x.x() / (x.z() * x.z()), 0.0,
                    focal_px.y() / x.z(), -focal_px.y() * x.y() / (x.z() * x.z());
                slope = slope * views_[view].cam_from_world.toRotationMatrix();
                normal_matrix += slope.transpose() * slope;
                right_side += slope.transpose() * (match.places_px[i] - *place);
            }
            position += normal_matrix.ldlt().solve(right_side);
        }
        return position;
    }

    /// The mean reprojection error; nothing if the position is behind a view.
    std::optional<double> error_px(const Match& match, const Vector3d& position) const
    {
        double sum = 0.0;
        for (std::size_t i = 0; i < match.views.size(); ++i) {
            const auto place = onlookers_.place_px(match.views[i], position);
            if (!place) return std::nullopt;
            sum += (*place - match.places_px[i]).norm();
        }
        return sum / static_cast<double>(match.views.size());
    }

    /// The mapper's criteria: two views, a reprojection error of up to 4 px, 1.5 degrees.
    bool is_good(const Match& match, const Vector3d& position) const
    {
        constexpr double kMostErrorPx = 4.0;
        static const double most_cosine = std::cos(1.5 * kDegree);
        if (match.views.size() < 2) return false;
        const auto error = error_px(match, position);
        if (!error || *error > kMostErrorPx) return false;
        const Vector3d way = (views_[match.views.front()].center - position).normalized();
        return std::ranges::any_of(match.views, [&](std::uint32_t view) {
            return way.dot((views_[view].center - position).normalized()) < most_cosine;
        });
    }

    void add(const Match& match, const Vector3d& position, const render::Paint& paint)
    {
        Scene& scene = model_.scene;
        const auto point = static_cast<std::uint32_t>(scene.num_points());
        for (std::size_t i = 0; i < match.views.size(); ++i) {
            model_.observations[match.views[i]].push_back({point, match.places_px[i]});
        }
        const Eigen::Array3i levels = (255.0F * paint.tint).round().cast<int>();
        scene.positions.push_back(position);
        scene.colors.push_back({static_cast<std::uint8_t>(levels[0]),
                                static_cast<std::uint8_t>(levels[1]),
                                static_cast<std::uint8_t>(levels[2])});
        scene.errors_px.push_back(*error_px(match, position));
        scene.point_ids.push_back(point + 1);
        scene.tracks.push_back(match.views);
    }

    Onlookers onlookers_;
    const std::vector<View>& views_;
    Spots spots_;
    ObservedModel model_;
};

using bench::Random;
using Eigen::Vector3d;

/// Makes points of depths on which views agree.
class Fusion {
  public:
    explicit Fusion(const ObservedScene& observed)
        : onlookers_(observed), spots_(observed.parts, Spread::area)
    {
        scene_.cameras = {onlookers_.camera()};
        scene_.views = onlookers_.views();
        scene_.is_dense = true;
    }

    void add_point(Random& random)
    {
        const Spot spot = spots_.draw(random);
        const std::vector<std::uint32_t> seeing = onlookers_.seeing(spot);
        if (seeing.empty()) return;
        const std::uint32_t reference = seeing[random.below(seeing.size())];
        const std::vector<std::uint32_t> views = agreeing(spot, reference, seeing, random);
        constexpr std::size_t kLeastViews = 3;
        const double off = depth_error(spot, reference, views.size(), random);
        const Vector3d normal = bent(spot.normal, random);
        if (views.size() < kLeastViews) return;
        const Vector3d& center = scene_.views[reference].center;
        add(center + (1.0 + off) * (spot.position - center), normal, spot.paint, views);
    }

    std::size_t num_points() const { return scene_.num_points(); }
    Scene take() { return std::move(scene_); }

  private:
    std::vector<std::uint32_t> agreeing(const Spot& spot, std::uint32_t reference,
                                        const std::vector<std::uint32_t>& seeing,
                                        Random& random) const
    {
        constexpr double kAgrees = 0.75;
        constexpr double kLeastCosine = 0.5; // 60 degrees
        const auto towards = [&](std::uint32_t view) -> Vector3d {
            return (scene_.views[view].center - spot.position).normalized();
        };
        std::vector<std::uint32_t> views;
        for (const std::uint32_t view : seeing) {
            const bool alike = towards(view).dot(towards(reference)) >= kLeastCosine;
            if (view == reference || (random.uniform() < kAgrees && alike)) views.push_back(view);
        }
        return views;
    }

    /// A random error, as a share of the depth.
    double depth_error(const Spot& spot, std::uint32_t reference, std::size_t num_views,
                       Random& random) const
    {
        constexpr double kDisparityPx = 0.5;
        constexpr double kBaseline = 0.2; // of the depth
        constexpr double kFalseShare = 1.0 / 200.0;
        constexpr double kMostFalse = 0.1;
        const double noise = random.normal();
        const double false_by = random.uniform(-kMostFalse, kMostFalse);
        if (random.uniform() < kFalseShare) return false_by;
        const double focal_px = onlookers_.camera().params[0];
        const double along = onlookers_.in_camera(reference, spot.position).z() /
                             (spot.position - scene_.views[reference].center).norm();
        return noise * along * kDisparityPx / (focal_px * kBaseline) /
               std::sqrt(static_cast<double>(num_views));
    }

    static Vector3d bent(const Vector3d& normal, Random& random)
    {
        constexpr double kBend = 0.1;
        return (normal + kBend * random.normal_3d()).normalized();
    }

    void add(const Vector3d& position, const Vector3d& normal, const render::Paint& paint,
             const std::vector<std::uint32_t>& views)
    {
        const Eigen::Array3i levels = (255.0F * paint.tint).round().cast<int>();
        scene_.positions.push_back(position);
        scene_.normals.emplace_back(normal.cast<float>());
        scene_.colors.push_back({static_cast<std::uint8_t>(levels[0]),
                                 static_cast<std::uint8_t>(levels[1]),
                                 static_cast<std::uint8_t>(levels[2])});
        scene_.errors_px.push_back(-1.0);
        scene_.point_ids.push_back(scene_.point_ids.size());
        scene_.tracks.push_back(views);
    }

    Onlookers onlookers_;
    Spots spots_;
    Scene scene_;
};

} // namespace

ObservedModel observe(const ObservedScene& observed)
{
    constexpr std::uint64_t kSeed = 1;
    const std::size_t most_tries = 100 * observed.points;
    Random random(kSeed);
    Matcher matcher(observed);
    for (std::size_t i = 0; i < most_tries && matcher.num_points() < observed.points; ++i) {
        matcher.add_point(random);
    }
    if (matcher.num_points() < observed.points) {
        throw std::runtime_error(observed.name + ": two views see too little of the scene");
    }
    return matcher.take();
}

Scene observe_densely(const ObservedScene& observed, std::size_t num_points)
{
    constexpr std::uint64_t kSeed = 2;
    const std::size_t most_tries = 100 * num_points;
    Random random(kSeed);
    Fusion fusion(observed);
    for (std::size_t i = 0; i < most_tries && fusion.num_points() < num_points; ++i) {
        fusion.add_point(random);
    }
    if (fusion.num_points() < num_points) {
        throw std::runtime_error(observed.name + ": three views see too little of the scene");
    }
    return fusion.take();
}

} // namespace vcarve::observed
