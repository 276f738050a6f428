#pragma once

#include "support/temporary_folder.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <iterator>
#include <numbers>
#include <string>

namespace vcarve {

/// Writes a COLMAP text model into `folder`: points along a spiral on the unit sphere around
/// `middle`. Six views, at distance 4 along the axes, see the points that face them. `lumps` varies
/// the radius by up to this fraction, because points of one sphere are not triangulated in blocks
/// (TooManyTies). It does not change the tracks.
inline void write_ball_model(const std::filesystem::path& folder, int num_points,
                             const Eigen::Vector3d& middle = Eigen::Vector3d::Zero(),
                             double lumps = 0.0)
{
    // Rotations (w x y z) of the axis of a view to the camera's z axis. The center is -4 times the
    // axis.
    constexpr double kHalf = 0.5 * std::numbers::sqrt2;
    static const std::array<const char*, 6> kNames = {"+z", "-z", "+y", "-y", "+x", "-x"};
    const std::array<Eigen::Vector4d, 6> rotations = {
        Eigen::Vector4d(0, 1, 0, 0),          Eigen::Vector4d(1, 0, 0, 0),
        Eigen::Vector4d(kHalf, -kHalf, 0, 0), Eigen::Vector4d(kHalf, kHalf, 0, 0),
        Eigen::Vector4d(kHalf, 0, kHalf, 0),  Eigen::Vector4d(kHalf, 0, -kHalf, 0)};
    const std::array<Eigen::Vector3d, 6> axes = {
        Eigen::Vector3d(0, 0, 1),  Eigen::Vector3d(0, 0, -1), Eigen::Vector3d(0, 1, 0),
        Eigen::Vector3d(0, -1, 0), Eigen::Vector3d(1, 0, 0),  Eigen::Vector3d(-1, 0, 0)};

    std::filesystem::create_directories(folder);
    std::ofstream(folder / "cameras.txt") << "1 SIMPLE_PINHOLE 1000 1000 1000 500 500\n";
    std::ofstream images(folder / "images.txt");
    for (std::size_t i = 0; i < axes.size(); ++i) {
        const Eigen::Vector4d& q = rotations[i];
        const Eigen::Vector3d moved =
            Eigen::Vector3d(0, 0, 4) - Eigen::Quaterniond(q[0], q[1], q[2], q[3]) * middle;
        images << fmt::format("{} {} {} {} {} {} 1 {}.jpg\n\n", i + 1, q[0], q[1], q[2], q[3],
                              fmt::join(moved, " "), kNames[i]);
    }
    std::string points;
    for (int i = 0; i < num_points; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / num_points;
        const double angle = std::numbers::pi * (3.0 - std::sqrt(5.0)) * i;
        const double radius = std::sqrt(1.0 - z * z);
        const Eigen::Vector3d p(radius * std::cos(angle), radius * std::sin(angle), z);
        const Eigen::Array3d waves = (9.0 * p.array() + Eigen::Array3d(0, 1, 2)).sin();
        const Eigen::Vector3d place = (1.0 + lumps * waves.prod()) * p + middle;
        fmt::format_to(std::back_inserter(points), "{} {} 200 100 50 0.5", i + 1,
                       fmt::join(place, " "));
        // A view at distance 4 sees the points of the unit sphere with a cosine above 1/4.
        for (std::size_t view = 0; view < axes.size(); ++view) {
            if (p.dot(axes[view]) > 0.3)
                fmt::format_to(std::back_inserter(points), " {} 0", view + 1);
        }
        points += '\n';
    }
    std::ofstream(folder / "points3D.txt") << points;
}

} // namespace vcarve
