#include "sample_scene.h"

#include "base/parallel.h"
#include "random.h"
#include "sample_shapes.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace vcarve::bench {

namespace {

using Eigen::Vector3d;
using ViewIndices = std::vector<std::uint32_t>;

/// The number of neighboring views that may see a point; all views for wide shapes.
std::size_t most_nearby(const SampleKind& kind, std::size_t views)
{
    constexpr std::size_t kNearby = 12;
    return kind.shape == Shape::wide ? views : std::min(kNearby, views);
}

/// The `most` nearest views of each view, nearest first, beginning with the view itself.
std::vector<ViewIndices> nearby_views(const std::vector<View>& views, std::size_t most)
{
    ViewIndices all(views.size());
    std::iota(all.begin(), all.end(), 0U);
    std::vector<ViewIndices> nearby;
    for (const View& view : views) {
        const auto distance = [&](std::uint32_t i) {
            return (views[i].center - view.center).squaredNorm();
        };
        std::ranges::stable_sort(all, {}, distance);
        nearby.emplace_back(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(most));
    }
    return nearby;
}

/// Photographs a shape: makes points and decides which views see them.
class Photographer {
  public:
    /// `spacing` is the spacing of the same number of evenly distributed points.
    Photographer(const SampleShape& shape, std::vector<View> views, const SampleKind& kind,
                 double spacing)
        : shape_(shape),
          views_(std::move(views)),
          nearby_(nearby_views(views_, most_nearby(kind, views_.size()))),
          kind_(kind),
          spacing_(spacing)
    {
    }

    const std::vector<View>& views() const { return views_; }

    void add_points(std::size_t count, std::uint64_t seed, Scene& scene) const
    {
        Random random(seed);
        for (std::size_t i = 0; i < count; ++i) {
            const bool is_outlier = random.uniform() < kind_.outliers;
            is_outlier&& kind_.shape != Shape::wide ? add_outlier(random, scene)
                                                    : add_seen(is_outlier, random, scene);
        }
    }

  private:
    /// Adds a point of the shape with noise. An outlier is shifted along its first ray.
    void add_seen(bool is_outlier, Random& random, Scene& scene) const
    {
        constexpr double kSlide = 0.25;
        const std::size_t wanted = track_length(random);
        while (true) {
            const Spot spot = shape_.spot(random);
            const double density = kind_.clustered ? density_at(spot.position) : 1.0;
            if (density < 1.0 && random.uniform() > density) continue;
            const std::uint32_t anchor = nearest_view(shape_.vantage(spot, random));
            const ViewIndices track =
                some_of(nearby_[anchor], wanted, random,
                        [&](std::uint32_t view) { return sees(views_[view], spot); });
            // Models have no points with fewer than two views.
            if (track.size() < 2) continue;
            Vector3d noise = spacing_ / std::sqrt(density) * noise_of(spot, track, random);
            if (is_outlier) {
                const Vector3d ray = views_[track.front()].center - spot.position;
                noise += kSlide * random.normal_3d().x() * ray.normalized();
            }
            return add(spot.position + noise, track, random, scene);
        }
    }

    /// The density at a position, 1/256 to 1, in clusters a tenth of the shape wide.
    static double density_at(const Vector3d& place)
    {
        constexpr double kFrequency = 15.0;
        const Eigen::Array3d waves = (kFrequency * place.array()).sin();
        return std::exp2(-4.0 * (1.0 - waves.sum() / 3.0));
    }

    /// The noise of a point, in spacings.
    Vector3d noise_of(const Spot& spot, const ViewIndices& track, Random& random) const
    {
        Vector3d ray = Vector3d::Zero();
        for (const std::uint32_t view : track) {
            ray += (spot.position - views_[view].center).normalized();
        }
        ray.normalize();
        const Vector3d even = random.normal_3d();
        return kind_.noise_across * even +
               (kind_.noise_along - kind_.noise_across) * ray.dot(even) * ray;
    }

    void add_outlier(Random& random, Scene& scene) const
    {
        const Eigen::AlignedBox3d box = shape_.box();
        const double x = random.uniform();
        const double y = random.uniform();
        const Vector3d share(x, y, random.uniform());
        const ViewIndices track = some_of(nearby_[random.below(views_.size())],
                                          track_length(random), random, [](auto) { return true; });
        add(box.min() + share.cwiseProduct(box.sizes()), track, random, scene);
    }

    static void add(const Vector3d& position, ViewIndices track, Random& random, Scene& scene)
    {
        std::ranges::sort(track);
        scene.positions.push_back(position);
        const Vector3d share = (0.5 * (position + Vector3d::Ones())).cwiseMax(0.0).cwiseMin(1.0);
        const Eigen::Array3i levels = (255.0 * share.array()).round().cast<int>();
        scene.colors.push_back({static_cast<std::uint8_t>(levels[0]),
                                static_cast<std::uint8_t>(levels[1]),
                                static_cast<std::uint8_t>(levels[2])});
        scene.errors_px.push_back(random.uniform(0.2, 1.4));
        scene.tracks.push_back(track);
    }

    /// 2 to 8, 3.7 on average; longer tracks are rarer.
    static std::size_t track_length(Random& random)
    {
        constexpr double kOneMore = 0.7;
        constexpr std::size_t kMost = 8;
        while (true) {
            std::size_t length = 2;
            while (length <= kMost && random.uniform() < kOneMore) {
                ++length;
            }
            if (length <= kMost) return length;
        }
    }

    /// Up to `wanted` random candidates for which `passes` returns true.
    template <typename Passes>
    static ViewIndices some_of(ViewIndices candidates, std::size_t wanted, Random& random,
                               const Passes& passes)
    {
        ViewIndices taken;
        for (std::size_t i = 0; i < candidates.size() && taken.size() < wanted; ++i) {
            std::swap(candidates[i], candidates[i + random.below(candidates.size() - i)]);
            if (passes(candidates[i])) taken.push_back(candidates[i]);
        }
        return taken;
    }

    std::uint32_t nearest_view(const Vector3d& place) const
    {
        const auto distance = [&](const View& view) { return (view.center - place).squaredNorm(); };
        return static_cast<std::uint32_t>(std::ranges::min_element(views_, {}, distance) -
                                          views_.begin());
    }

    bool sees(const View& view, const Spot& spot) const
    {
        constexpr double kGrazing = 0.25; // cosine, about 75 degrees off the normal
        const Vector3d towards = (view.center - spot.position).normalized();
        if (spot.normal.dot(towards) < kGrazing) return false;
        const Vector3d place_in_camera = in_camera(view, spot.position);
        if (place_in_camera.z() <= 0.0) return false;
        const auto size_px = static_cast<double>(sample_camera_.width_px);
        const Eigen::Array2d pixel_px = in_image(place_in_camera);
        if ((pixel_px < 0.0).any() || (pixel_px > size_px).any()) return false;
        return !is_hidden(spot.position, view.center);
    }

    /// Whether the shape occludes a spot from a view.
    bool is_hidden(const Vector3d& spot, const Vector3d& center) const
    {
        constexpr double kStep = 0.04; // a quarter of the narrowest hill
        const double distance = (center - spot).norm();
        const Vector3d towards = (center - spot) / distance;
        for (double along = kStep; along < distance; along += kStep) {
            const Vector3d place = spot + along * towards;
            if (!box_.contains(place)) return false;
            if (shape_.height_above(place) < 0.0) return true;
        }
        return false;
    }

    const SampleShape& shape_;
    std::vector<View> views_;
    std::vector<ViewIndices> nearby_;
    SampleKind kind_;
    double spacing_;
    Eigen::AlignedBox3d box_ = shape_.box();
    Camera sample_camera_ = sample_camera();
};

std::unique_ptr<SampleShape> make_shape(Shape shape)
{
    switch (shape) {
    case Shape::surface:
    case Shape::wide:
        return bumpy_ball();
    case Shape::terrain:
        return terrain();
    case Shape::hall:
        return hall();
    }
    return nullptr;
}

void append(const Scene& block, Scene& scene)
{
    const auto add = [](const auto& from, auto& to) {
        to.insert(to.end(), from.begin(), from.end());
    };
    add(block.positions, scene.positions);
    add(block.colors, scene.colors);
    add(block.errors_px, scene.errors_px);
    for (std::size_t point = 0; point < block.num_points(); ++point) {
        scene.tracks.push_back(block.tracks[point]);
    }
}

/// The cameras and views of a sample.
Scene numbered_views(std::vector<View> views)
{
    Scene scene;
    scene.cameras = {sample_camera()};
    scene.views = std::move(views);
    for (std::size_t i = 0; i < scene.views.size(); ++i) {
        scene.views[i].id = static_cast<std::uint32_t>(i + 1);
        scene.views[i].name = fmt::format("{:04}.jpg", i + 1);
    }
    return scene;
}

class SampleParts final : public SceneParts {
  public:
    SampleParts(const SampleKind& kind, std::size_t points)
        : shape_(make_shape(kind.shape)),
          num_points_(points),
          photographer_(*shape_, shape_->views(kind.views_of(points)), kind,
                        std::sqrt(shape_->area() / static_cast<double>(points))),
          views_(numbered_views(photographer_.views()))
    {
    }

    std::size_t num_points() const override { return num_points_; }

    Scene next(std::size_t most, const Progress& progress) override
    {
        const std::size_t left = num_points_ - first_;
        const std::size_t whole = most >= left ? left : most / kSampleBlock * kSampleBlock;
        std::vector<Scene> blocks((whole + kSampleBlock - 1) / kSampleBlock);
        const auto fill = [&](std::size_t i) {
            const std::size_t count = std::min(kSampleBlock, whole - i * kSampleBlock);
            photographer_.add_points(count, first_ / kSampleBlock + i, blocks[i]);
        };
        parallel_for(blocks.size(), fill, 1);

        Scene scene = views_;
        for (Scene& block : blocks) {
            append(block, scene);
            block = {};
        }
        scene.point_ids.resize(whole);
        std::iota(scene.point_ids.begin(), scene.point_ids.end(), std::uint64_t{first_} + 1);
        first_ += whole;
        progress.report(1.0);
        return scene;
    }

  private:
    std::unique_ptr<SampleShape> shape_;
    std::size_t num_points_;
    Photographer photographer_;
    Scene views_;
    std::size_t first_ = 0; ///< first point of the next part, which is the first of a block
};

} // namespace

Shape shape_named(std::string_view name)
{
    for (const Shape shape : {Shape::surface, Shape::terrain, Shape::hall, Shape::wide}) {
        if (name == name_of(shape)) return shape;
    }
    throw UsageError(
        fmt::format("unknown sample \"{}\"; expected surface, terrain, hall or wide", name));
}

const char* name_of(Shape shape)
{
    switch (shape) {
    case Shape::surface:
        return "surface";
    case Shape::terrain:
        return "terrain";
    case Shape::hall:
        return "hall";
    case Shape::wide:
        return "wide";
    }
    return "";
}

std::string name_of(const SampleKind& kind)
{
    const SampleKind usual;
    std::string name = name_of(kind.shape);
    if (kind.noise_along != usual.noise_along) name += fmt::format("_along{}", kind.noise_along);
    if (kind.noise_across != usual.noise_across) {
        name += fmt::format("_across{}", kind.noise_across);
    }
    if (kind.outliers != usual.outliers) name += fmt::format("_outliers{}", kind.outliers);
    if (kind.clustered) name += "_clustered";
    return kind.views != 0 ? name + fmt::format("_{}views", kind.views) : name;
}

std::size_t SampleKind::views_of(std::size_t points) const
{
    constexpr std::size_t kMany = 1'000'000;
    if (views != 0) return views;
    return points >= kMany ? 300 : 100;
}

std::unique_ptr<SceneParts> sample_parts(const SampleKind& kind, std::size_t points)
{
    return std::make_unique<SampleParts>(kind, points);
}

Scene make_sample_scene(const SampleKind& kind, std::size_t points)
{
    return SampleParts(kind, points).next(points, {});
}

} // namespace vcarve::bench
