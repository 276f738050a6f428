#include "texture/occlusion.h"

#include "geometry/triangle.h"
#include "mesh/vertices.h"

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
    constexpr double kNear = 1e-3; // of the way
    const Vector3d way = position - center;
    const FirstFace hit = faces_.from(center, way.normalized());
    if (hit.face == face) return true;
    if (hit.face == FirstFace::kNone) return false;
    const auto [a, b, c] = corners_of(mesh_.positions, mesh_.faces[hit.face]);
    const double second = hit.second;
    const double third = hit.third;
    const Vector3d met = (1.0 - second - third) * a + second * b + third * c;
    return (met - center).norm() >= (1.0 - kNear) * way.norm();
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
