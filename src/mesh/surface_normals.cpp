#include "mesh/surface_normals.h"

#include "geometry/triangle.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

using Eigen::Vector3d;

Vector3d SurfaceNormals::of(std::size_t face) const
{
    return face_normal(positions_, faces_[face]);
}

Vector3d SurfaceNormals::at(std::uint32_t vertex) const
{
    constexpr double kSmall = 2.0; // relative size
    Vector3d sum = Vector3d::Zero();
    for (const std::uint32_t face : edges_.faces_at()[vertex]) {
        const Vector3d normal = of(face);
        if (edges_.relative_size(face) < kSmall && normal.allFinite()) sum += normal;
    }
    return sum.normalized(); // leaves zero as it is
}

std::array<double, 3> SurfaceNormals::cosines(std::size_t face, double unknown) const
{
    const Vector3d normal = of(face);
    std::array<double, 3> cosines{};
    std::ranges::transform(faces_[face], cosines.begin(), [&](std::uint32_t vertex) {
        const Vector3d around = at(vertex);
        return around.isZero() ? unknown : normal.dot(around);
    });
    std::ranges::sort(cosines);
    return cosines;
}

bool goes_on(std::size_t face, const SurfaceNormals& normals)
{
    constexpr double kGoesOn = 0.9; // cosine, about 26 degrees
    constexpr double kUnknown = -1.0;
    return normals.cosines(face, kUnknown)[2] >= kGoesOn;
}

} // namespace vcarve
