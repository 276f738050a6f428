#include "render/photograph.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace vcarve::render {

namespace {

constexpr int kSamplesASide = 2;

/// Ambient light plus diffuse light from one side, so that corners are visible.
float light(const Eigen::Vector3d& normal)
{
    const Eigen::Vector3d sun = Eigen::Vector3d(-0.4, -0.7, 0.9).normalized();
    return static_cast<float>(0.55 + 0.45 * std::max(0.0, normal.dot(sun)));
}

/// Blurs along one axis of the image; border pixels are repeated outside.
Picture blurred_along(const Picture& picture, double sigma_px, int step_x, int step_y)
{
    const int reach = static_cast<int>(std::ceil(3.0 * sigma_px));
    Picture result = picture;
    for (int y = 0; y < picture.height_px; ++y) {
        for (int x = 0; x < picture.width_px; ++x) {
            Eigen::Array3f sum = Eigen::Array3f::Zero();
            float total = 0.0F;
            for (int i = -reach; i <= reach; ++i) {
                const auto weight =
                    static_cast<float>(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
                const int from_x = std::clamp(x + i * step_x, 0, picture.width_px - 1);
                const int from_y = std::clamp(y + i * step_y, 0, picture.height_px - 1);
                sum += weight *
                       picture.pixels[static_cast<std::size_t>(from_y) * picture.width_px + from_x];
                total += weight;
            }
            result.pixels[static_cast<std::size_t>(y) * picture.width_px + x] = sum / total;
        }
    }
    return result;
}

/// A normally distributed number (Box and Muller), the same with every library.
double normal_number(std::mt19937& random)
{
    const double share = (static_cast<double>(random()) + 1.0) / 4294967297.0;
    const double turn = 2.0 * std::numbers::pi * static_cast<double>(random()) / 4294967296.0;
    return std::sqrt(-2.0 * std::log(share)) * std::cos(turn);
}

using Corner = Eigen::Matrix<std::int32_t, 3, 1>;

/// A random number between 0 and 1 for a corner of a lattice.
double value_at(const Corner& corner, std::uint32_t seed)
{
    std::uint32_t mixed = seed * 0x9e3779b9U + 0x7f4a7c15U;
    for (int k = 0; k < 3; ++k) {
        mixed ^= static_cast<std::uint32_t>(corner[k]) * 0x85ebca6bU;
        mixed = (mixed ^ (mixed >> 16)) * 0xc2b2ae35U;
        mixed ^= mixed >> 13;
    }
    return static_cast<double>(mixed) / 4294967295.0;
}

/// Smoothly interpolates the values at the eight corners around a position.
double lattice_noise(const Eigen::Vector3d& place, std::uint32_t seed)
{
    const Eigen::Vector3d floor = place.array().floor();
    const Eigen::Array3d t = (place - floor).array();
    const Eigen::Array3d smooth = t * t * (3.0 - 2.0 * t);
    double sum = 0.0;
    for (int i = 0; i < 8; ++i) {
        const Corner step((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
        double weight = 1.0;
        for (int k = 0; k < 3; ++k) {
            weight *= step[k] != 0 ? smooth[k] : 1.0 - smooth[k];
        }
        sum += weight * value_at(floor.cast<std::int32_t>() + step, seed);
    }
    return sum;
}

} // namespace

Picture photograph(const Parts& parts, const Pinhole& view)
{
    const SolidNoise noise{0.5, 8, 2000};
    const Pinhole fine = enlarged(view, kSamplesASide);
    const std::vector<Hit> hits = rasterize(parts.mesh, fine);
    Picture picture{fine.width_px, fine.height_px, {}};
    picture.pixels.assign(hits.size(), Eigen::Array3f::Constant(128.0F));
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits[i];
        if (hit.face == Hit::kNoFace) continue;
        const std::size_t row = i / fine.width_px;
        const std::size_t column = i % fine.width_px;
        const Eigen::Vector2d pixel(static_cast<double>(column) + 0.5,
                                    static_cast<double>(row) + 0.5);
        const Eigen::Vector3d place = fine.center + hit.depth * fine.ray(pixel);
        const std::uint32_t part = parts.part_of_face[hit.face];
        const Paint& paint = parts.paint_of_part[part];
        const Eigen::Vector3d apart = place / paint.stretch + 10.0 * part * Eigen::Vector3d::Ones();
        const double share = 0.5 + paint.contrast * (noise.at(apart) - 0.5);
        const auto pattern = static_cast<float>(0.15 + 0.85 * share);
        const float brightness = 255.0F * light(face_normal(parts.mesh, hit.face)) * pattern;
        picture.pixels[i] = brightness * paint.tint;
    }
    return shrunk(picture, kSamplesASide);
}

Picture grainy(const Picture& picture, const Grain& grain, std::uint32_t seed)
{
    Picture result = picture;
    if (grain.blur_px > 0.0) {
        result = blurred_along(blurred_along(result, grain.blur_px, 1, 0), grain.blur_px, 0, 1);
    }
    if (grain.noise > 0.0) {
        std::mt19937 random(seed);
        for (Eigen::Array3f& pixel : result.pixels) {
            for (int k = 0; k < 3; ++k) {
                pixel[k] += static_cast<float>(grain.noise * normal_number(random));
            }
        }
    }
    return result;
}

double SolidNoise::at(const Eigen::Vector3d& place) const
{
    double sum = 0.0;
    for (int i = 0; i < lattices; ++i) {
        const Eigen::Vector3d scaled = place * std::ldexp(1.0 / coarsest, i);
        sum += lattice_noise(scaled, seed + static_cast<std::uint32_t>(i)) - 0.5;
    }
    return std::clamp(0.5 + 0.7 * sum, 0.0, 1.0);
}

} // namespace vcarve::render
