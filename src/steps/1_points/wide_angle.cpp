#include "steps/1_points/wide_angle.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int kExtents = 16;

/// The least and greatest coordinate along an axis, and the rays that have them.
struct Extent {
    double least = kUnset;
    double greatest = -kUnset;
    std::size_t first = 0;
    std::size_t last = 0;

    static constexpr double kUnset = 1e300;

    void add(double coordinate, std::size_t ray)
    {
        if (coordinate < least) {
            least = coordinate;
            first = ray;
        }
        if (coordinate > greatest) {
            greatest = coordinate;
            last = ray;
        }
    }
    double length() const { return greatest - least; }
};

/// The extents of unit vectors along the first, and in directions perpendicular to it.
struct Extents {
    Extent along;
    std::array<Extent, kExtents> across;
};

Extents extents_of(std::span<const Vector3d> rays)
{
    std::array<Vector2d, kExtents> axes;
    for (int k = 0; k < kExtents; ++k) {
        const double angle = std::numbers::pi * k / kExtents;
        axes[k] = Vector2d(std::cos(angle), std::sin(angle));
    }
    const Vector3d forward = rays[0].normalized();
    const Vector3d right = forward.unitOrthogonal();
    const Vector3d down = forward.cross(right);
    Extents extents;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vector3d unit = rays[i].normalized();
        const Vector2d place(right.dot(unit), down.dot(unit));
        extents.along.add(forward.dot(unit), i);
        for (int k = 0; k < kExtents; ++k) {
            extents.across[k].add(axes[k].dot(place), i);
        }
    }
    return extents;
}

/// An upper bound for the distance of two unit vectors.
double longest_chord(const Extents& extents)
{
    double longest = 0.0;
    for (const Extent& extent : extents.across) {
        longest = std::max(longest, extent.length());
    }
    // Any direction is this close to one of the axes.
    const double across = longest / std::cos(0.5 * std::numbers::pi / kExtents);
    return std::hypot(across, extents.along.length());
}

/// Whether products of four lengths neither overflow nor vanish.
bool are_usual(std::span<const Vector3d> rays)
{
    constexpr double kLeast = 1e-60;
    constexpr double kMost = 1e60;
    return std::ranges::all_of(rays, [](const Vector3d& ray) {
        const double largest = ray.cwiseAbs().maxCoeff();
        return largest > kLeast && largest < kMost;
    });
}

} // namespace

AngleSearch look_for_angle(std::span<const Vector3d> rays, double min_angle_rad)
{
    constexpr std::size_t kFew = 8; // their pairs cost less than the extents
    AngleSearch search;
    const auto is_wide = [&](std::size_t i, std::size_t j) {
        ++search.num_angles;
        const double sine = rays[i].cross(rays[j]).norm();
        const double cosine = rays[i].dot(rays[j]);
        search.is_found = std::atan2(sine, cosine) >= min_angle_rad;
        return search.is_found;
    };
    for (std::size_t i = 1; i < rays.size(); ++i) {
        if (is_wide(i, 0)) return search;
    }
    if (rays.size() > kFew && are_usual(rays)) {
        constexpr double kRounding = 1e-12;
        const Extents extents = extents_of(rays);
        const double min_chord = 2.0 * std::sin(0.5 * min_angle_rad);
        if (longest_chord(extents) + kRounding < min_chord) return search;
        for (const Extent& extent : extents.across) {
            if (is_wide(extent.first, extent.last)) return search;
        }
    }
    for (std::size_t i = 2; i < rays.size(); ++i) {
        for (std::size_t j = 1; j < i; ++j) {
            if (is_wide(i, j)) return search;
        }
    }
    return search;
}

} // namespace vcarve
