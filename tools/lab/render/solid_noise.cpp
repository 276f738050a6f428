#include "render/solid_noise.h"

#include <algorithm>
#include <cmath>

namespace vcarve::render {

namespace {

using Corner = Eigen::Matrix<std::int32_t, 3, 1>;

/// A number between 0 and 1 that belongs to a corner of a lattice.
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

/// Blends the values at the eight corners around a place smoothly.
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
