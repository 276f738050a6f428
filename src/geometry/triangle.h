#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

namespace vcarve {

/// The normal of a triangle; its length is twice the area. Seen from its tip, a, b, c are
/// counter-clockwise.
inline Eigen::Vector3d scaled_normal(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                     const Eigen::Vector3d& c)
{
    return (b - a).cross(c - a);
}

inline double triangle_area(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                            const Eigen::Vector3d& c)
{
    return 0.5 * scaled_normal(a, b, c).norm();
}

/// The same for a face with the given vertex indices.
inline Eigen::Vector3d scaled_normal(std::span<const Eigen::Vector3d> positions,
                                     const std::array<std::uint32_t, 3>& face)
{
    return scaled_normal(positions[face[0]], positions[face[1]], positions[face[2]]);
}

inline double face_area(std::span<const Eigen::Vector3d> positions,
                        const std::array<std::uint32_t, 3>& face)
{
    return 0.5 * scaled_normal(positions, face).norm();
}

/// The unit normal of a face, pointing outside; zero if the face has no area.
inline Eigen::Vector3d face_normal(std::span<const Eigen::Vector3d> positions,
                                   const std::array<std::uint32_t, 3>& face)
{
    return scaled_normal(positions, face).normalized();
}

inline double longest_edge(const std::array<Eigen::Vector3d, 3>& corners)
{
    const auto& [a, b, c] = corners;
    return std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
}

inline std::array<Eigen::Vector3d, 3> corners_of(std::span<const Eigen::Vector3d> positions,
                                                 const std::array<std::uint32_t, 3>& face)
{
    return {positions[face[0]], positions[face[1]], positions[face[2]]};
}

inline double longest_edge(std::span<const Eigen::Vector3d> positions,
                           const std::array<std::uint32_t, 3>& face)
{
    return longest_edge(corners_of(positions, face));
}

/// Whether a face turns by more than 60 degrees when its corners move, or has no area before or
/// after. Moved vertices must not flip faces.
inline bool turns_too_far(const std::array<Eigen::Vector3d, 3>& before,
                          const std::array<Eigen::Vector3d, 3>& after)
{
    constexpr double kLeastCosine = 0.5;
    const Eigen::Vector3d old_normal = scaled_normal(before[0], before[1], before[2]);
    const Eigen::Vector3d new_normal = scaled_normal(after[0], after[1], after[2]);
    const double scale = old_normal.norm() * new_normal.norm();
    return !(old_normal.dot(new_normal) > kLeastCosine * scale);
}

} // namespace vcarve
