#include "texture/occlusion.h"

#include "geometry/triangle.h"
#include "mesh/vertices.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

using Eigen::Vector3d;

std::array<Vector3d, 7> face_samples(const std::array<Vector3d, 3>& corners)
{
    constexpr double kPulled = 0.08;
    const auto& [a, b, c] = corners;
    const Vector3d middle = (a + b + c) / 3.0;
    std::array<Vector3d, 7> places = {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a), middle};
    for (Vector3d& place : places) {
        place += kPulled * (middle - place);
    }
    return places;
}

Occlusion::Occlusion(const TriMesh& mesh) : mesh_(mesh), faces_(mesh_, box_center(mesh)) {}

bool Occlusion::sees(const Vector3d& center, const Vector3d& position, std::uint32_t face) const
{
    constexpr double kNear = 1e-3; // of the distance
    const Vector3d way = position - center;
    const FirstFace hit = faces_.from(center, way.normalized());
    if (hit.face == face) return true;
    if (hit.face == FirstFace::kNone) return false;
    return (position_of(hit) - center).norm() >= (1.0 - kNear) * way.norm();
}

bool Occlusion::is_near_silhouette(const CalibratedPhoto& photo,
                                   const std::array<Vector3d, 3>& corners) const
{
    constexpr double kNearPx = 3.0;
    constexpr double kSteep = 10.0; // depth difference per sideways step
    const auto& [a, b, c] = corners;
    const Vector3d middle = (a + b + c) / 3.0;
    const Vector3d& center = photo.pose.center;
    const std::array<Vector3d, 6> rim = {a, b, c, 0.5 * (a + b), 0.5 * (b + c), 0.5 * (c + a)};
    return std::ranges::any_of(rim, [&](const Vector3d& position) {
        const double distance = (position - center).norm();
        const Vector3d view = (position - center) / distance;
        const Vector3d out = position - middle;
        const double out_in_image = (out - out.dot(view) * view).norm();
        if (!(out_in_image > 0.0)) return false;
        const double step = kNearPx * distance / photo.focal_px;
        const Vector3d way = position + step / out_in_image * out - center;
        const FirstFace hit = faces_.from(center, way.normalized());
        if (hit.face == FirstFace::kNone) return true;
        return std::abs((position_of(hit) - center).norm() - way.norm()) > kSteep * step;
    });
}

Vector3d Occlusion::position_of(const FirstFace& hit) const
{
    const auto [a, b, c] = corners_of(mesh_.positions, mesh_.faces[hit.face]);
    const double second = hit.second;
    const double third = hit.third;
    return (1.0 - second - third) * a + second * b + third * c;
}

int Occlusion::seen_places(const CalibratedPhoto& photo, const std::array<Vector3d, 3>& corners,
                           std::uint32_t face) const
{
    int seen = 0;
    for (const Vector3d& place : face_samples(corners)) {
        seen += pixel_of(photo, place) && sees(photo.pose.center, place, face) ? 1 : 0;
    }
    return seen;
}

} // namespace vcarve
