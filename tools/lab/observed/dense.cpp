#include "observed/dense.h"

#include "observed/observe.h"
#include "observed/onlookers.h"
#include "observed/spots.h"
#include "observed/write_model.h"
#include "random.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>

namespace vcarve::observed {

namespace {

using bench::Random;
using Eigen::Vector3d;

/// Makes points of depths that views agree on.
class Fusion {
  public:
    explicit Fusion(const ObservedScene& observed)
        : onlookers_(observed), spots_(observed.parts, Spread::area)
    {
        scene_.cameras = {onlookers_.camera()};
        scene_.views = onlookers_.views();
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

    /// As a share of the depth.
    double depth_error(const Spot& spot, std::uint32_t reference, std::size_t num_views,
                       Random& random) const
    {
        constexpr double kDisparityPx = 0.5;
        constexpr double kBaseline = 0.2; // of the depth
        constexpr double kFalse = 1.0 / 200.0;
        constexpr double kMostFalse = 0.1;
        const double noise = random.normal();
        const double false_by = random.uniform(-kMostFalse, kMostFalse);
        if (random.uniform() < kFalse) return false_by;
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

/// The views in the order a mapper might have registered them in: every eleventh, round and round.
std::vector<std::uint32_t> registered_order(std::size_t num_views)
{
    std::vector<std::uint32_t> order;
    for (std::size_t first = 0; first < 11; ++first) {
        for (std::size_t view = first; view < num_views; view += 11) {
            order.push_back(static_cast<std::uint32_t>(view));
        }
    }
    return order;
}

template <typename Number>
void put(std::ofstream& file, Number value)
{
    file.write(reinterpret_cast<const char*>(&value), sizeof(value));
}

/// Rounded to a ten-thousandth, so that the last bits of sine and cosine do not show.
float rounded(double value)
{
    return static_cast<float>(1e-4 * std::round(1e4 * value));
}

void write_cloud(const std::filesystem::path& path, const Scene& scene)
{
    std::ofstream file(path, std::ios::binary);
    file << "ply\nformat binary_little_endian 1.0\nelement vertex " << scene.num_points();
    for (const char* name : {"x", "y", "z", "nx", "ny", "nz"}) {
        file << "\nproperty float " << name;
    }
    file << "\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        for (const double coordinate : scene.positions[i]) {
            put(file, rounded(coordinate));
        }
        for (const float coordinate : scene.normals[i]) {
            put(file, rounded(coordinate));
        }
        for (const std::uint8_t channel : scene.colors[i]) {
            put(file, channel);
        }
    }
}

void write_visibility(const std::filesystem::path& path, const Scene& scene,
                      const std::vector<std::uint32_t>& order)
{
    std::vector<std::uint32_t> place_of(order.size());
    for (std::uint32_t place = 0; place < order.size(); ++place) {
        place_of[order[place]] = place;
    }
    std::ofstream file(path, std::ios::binary);
    put(file, std::uint64_t{scene.num_points()});
    for (std::size_t i = 0; i < scene.num_points(); ++i) {
        put(file, static_cast<std::uint32_t>(scene.tracks[i].size()));
        for (const std::uint32_t view : scene.tracks[i]) {
            put(file, place_of[view]);
        }
    }
}

} // namespace

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
        throw std::runtime_error(observed.name +
                                 ": too little of the scene is seen by three views");
    }
    return fusion.take();
}

void write_workspace(const std::filesystem::path& folder, const Scene& scene)
{
    const std::vector<std::uint32_t> order = registered_order(scene.views.size());
    ObservedModel model;
    model.scene.cameras = scene.cameras;
    for (const std::uint32_t view : order) {
        model.scene.views.push_back(scene.views[view]);
    }
    model.observations.resize(scene.views.size());
    write_model(folder / "sparse", model);
    write_cloud(folder / "fused.ply", scene);
    write_visibility(folder / "fused.ply.vis", scene, order);
}

} // namespace vcarve::observed
