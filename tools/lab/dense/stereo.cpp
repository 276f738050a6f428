#include "dense/stereo.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "render/photograph.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vcarve::dense {

namespace {

using Eigen::Vector3d;
using render::Hit;
using render::Pinhole;

/// A number of a normal distribution that depends on nothing but its arguments (Box and Muller).
double normal_number(std::uint64_t seed, std::uint64_t index)
{
    const double u = 1.0 - random_number(seed, 2 * index);
    const double v = random_number(seed, 2 * index + 1);
    return std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * std::numbers::pi * v);
}

/// Numbers of a normal distribution, each the mean of a window of 5 x 5 of others.
std::vector<double> smooth_numbers(int width, int height, std::uint64_t seed)
{
    constexpr std::uint64_t kSide = 5;
    std::vector<double> result(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::uint64_t padded = static_cast<std::uint64_t>(width) + kSide - 1;
    parallel_for(result.size(), [&](std::size_t i) {
        const std::uint64_t x = i % static_cast<std::size_t>(width);
        const std::uint64_t y = i / static_cast<std::size_t>(width);
        double sum = 0.0;
        for (std::uint64_t dy = 0; dy < kSide; ++dy) {
            for (std::uint64_t dx = 0; dx < kSide; ++dx) {
                sum += normal_number(seed, (y + dy) * padded + x + dx);
            }
        }
        result[i] =
            sum / static_cast<double>(kSide); // of 25 numbers: a standard deviation of 1 again
    });
    return result;
}

/// The distance to the sixth nearest centre of another view: a matcher looks at several.
double baseline(const std::vector<Pinhole>& views, std::size_t view)
{
    std::vector<double> distances;
    for (std::size_t other = 0; other < views.size(); ++other) {
        if (other != view) distances.push_back((views[other].center - views[view].center).norm());
    }
    std::ranges::sort(distances);
    return distances.at(std::min<std::size_t>(5, distances.size() - 1));
}

/// Whether the depth jumps within two pixels.
bool is_at_jump(const std::vector<Hit>& hits, const Pinhole& view, int x, int y)
{
    constexpr double kJump = 0.03;
    const auto hit_at = [&](int u, int v) -> const Hit& {
        return hits[static_cast<std::size_t>(v) * static_cast<std::size_t>(view.width_px) +
                    static_cast<std::size_t>(u)];
    };
    const double depth = hit_at(x, y).depth;
    for (int v = std::max(0, y - 2); v <= std::min(view.height_px - 1, y + 2); ++v) {
        for (int u = std::max(0, x - 2); u <= std::min(view.width_px - 1, x + 2); ++u) {
            const Hit& hit = hit_at(u, v);
            if (hit.face == Hit::kNoFace || std::abs(hit.depth - depth) > kJump * depth)
                return true;
        }
    }
    return false;
}

/// A normal turned by two angles of a normal distribution.
Vector3d shaken(const Vector3d& normal, double sigma_deg, std::uint64_t seed, std::uint64_t index)
{
    const double sigma = sigma_deg * std::numbers::pi / 180.0;
    const Vector3d u = normal.unitOrthogonal();
    return (normal + sigma * normal_number(seed, 2 * index) * u +
            sigma * normal_number(seed, 2 * index + 1) * normal.cross(u))
        .normalized();
}

} // namespace

DepthMap stereo_depths(const render::PhotoScene& scene, std::size_t view, const StereoNoise& noise,
                       std::uint64_t seed)
{
    const Pinhole& lens = scene.views[view];
    const std::vector<Hit> hits = render::rasterize(scene.parts.mesh, lens);
    const Picture picture = render::photograph(scene.parts, lens);
    const std::uint64_t own = (seed << 20U) + 8 * view;
    const std::vector<double> smooth = smooth_numbers(lens.width_px, lens.height_px, own);
    const double scale = 1.0 / (lens.focal_px.x() * baseline(scene.views, view));
    const double least_cosine = std::cos(noise.most_slant_deg * std::numbers::pi / 180.0);

    DepthMap map{std::vector<double>(hits.size(), 0.0), std::vector<Vector3d>(hits.size()), {}};
    for (const Eigen::Array3f& pixel : picture.pixels) {
        map.colors.push_back({static_cast<std::uint8_t>(pixel[0]),
                              static_cast<std::uint8_t>(pixel[1]),
                              static_cast<std::uint8_t>(pixel[2])});
    }
    parallel_for(hits.size(), [&](std::size_t i) {
        const int x = static_cast<int>(i) % lens.width_px;
        const int y = static_cast<int>(i) / lens.width_px;
        const Hit& hit = hits[i];
        if (hit.face == Hit::kNoFace || !hit.front || is_at_jump(hits, lens, x, y)) return;
        const Vector3d normal = render::face_normal(scene.parts.mesh, hit.face);
        const Vector3d ray = lens.ray({x + 0.5, y + 0.5}).normalized();
        if (-normal.dot(ray) < least_cosine) return;
        const double error_px =
            noise.smooth_px * smooth[i] + noise.rough_px * normal_number(own + 1, i);
        map.depths[i] = hit.depth * (1.0 + error_px * hit.depth * scale);
        if (random_number(own + 2, i) < noise.outliers)
            map.depths[i] = hit.depth * (0.6 + 0.8 * random_number(own + 3, i));
        map.normals[i] = shaken(normal, noise.normal_deg, own + 4, i);
    });
    return map;
}

} // namespace vcarve::dense
