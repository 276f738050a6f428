#include "photo_refine/mesh_depth.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace vcarve {

namespace {

/// The depth change along a pixel's ray of a face that moves along its normal.
class FaceStep {
  public:
    FaceStep(const TriMesh& mesh, const Face& face, const StereoView& view,
             std::span<const float> steps)
        : camera_(view.camera)
    {
        const auto& a = mesh.positions[face[0]];
        const Eigen::Vector3d normal =
            (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a);
        normal_ = (view.cam_from_world * normal.normalized()).cast<float>();
        step_ = (steps[face[0]] + steps[face[1]] + steps[face[2]]) / 3.0F;
    }

    float at(int x, int y) const
    {
        const Eigen::Vector3f ray = camera_.ray(static_cast<float>(x), static_cast<float>(y));
        return step_ / std::max(std::abs(normal_.dot(ray)), kLeastCosine);
    }

  private:
    const Pinhole& camera_;
    Eigen::Vector3f normal_;
    float step_;
};

/// Calls visit(x, y, z) for the pixels whose centers a projected face covers.
template <typename Visit>
void visit_pixels(const std::array<PixelDepth, 3>& corners, int width_px, int height_px,
                  const Visit& visit)
{
    constexpr float kOutside = -1e-4F; // neighboring faces overlap, so that no pixel is lost
    const auto& [a, b, c] = corners;
    const auto [left, right] = std::minmax({a.x, b.x, c.x});
    const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
    const auto last_x = static_cast<float>(width_px - 1);
    const auto last_y = static_cast<float>(height_px - 1);
    if (!(right >= 0.0F && bottom >= 0.0F && left <= last_x && top <= last_y)) return;
    const int first_x = static_cast<int>(std::ceil(std::max(left, 0.0F)));
    const int first_y = static_cast<int>(std::ceil(std::max(top, 0.0F)));
    const int end_x = static_cast<int>(std::min(right, last_x));
    const int end_y = static_cast<int>(std::min(bottom, last_y));
    const float area = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    if (area == 0.0F) return;
    const float inverse = 1.0F / area;
    for (int y = first_y; y <= end_y; ++y) {
        const float down = static_cast<float>(y) - a.y;
        for (int x = first_x; x <= end_x; ++x) {
            const float along = static_cast<float>(x) - a.x;
            const float second = (along * (c.y - a.y) - down * (c.x - a.x)) * inverse;
            const float third = ((b.x - a.x) * down - (b.y - a.y) * along) * inverse;
            const float first = 1.0F - second - third;
            if (first < kOutside || second < kOutside || third < kOutside) continue;
            visit(x, y, 1.0F / (first / a.z + second / b.z + third / c.z));
        }
    }
}

} // namespace

PixelDepth pixel_depth(const StereoView& view, const Eigen::Vector3d& position)
{
    const Eigen::Vector3d in_cam = view.cam_from_world * (position - view.center);
    if (!(in_cam.z() > 0.0)) return {};
    const Eigen::Vector2d pixel = view.camera.focal_px / in_cam.z() * in_cam.head<2>() +
                                  view.camera.principal_px.cast<double>();
    return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y()),
            static_cast<float>(in_cam.z())};
}

MeshDepth mesh_depth(const TriMesh& mesh, const StereoView& view, std::span<const float> steps)
{
    const int width = view.image.width_px;
    const int height = view.image.height_px;
    MeshDepth drawn;
    drawn.depth.assign(static_cast<std::size_t>(width) * height,
                       std::numeric_limits<float>::infinity());
    if (!steps.empty()) drawn.step.assign(drawn.depth.size(), 0.0F);
    std::vector<PixelDepth> corners;
    corners.reserve(mesh.positions.size());
    for (const Eigen::Vector3d& position : mesh.positions) {
        corners.push_back(pixel_depth(view, position));
    }
    for (const Face& face : mesh.faces) {
        const std::array<PixelDepth, 3> of_face = {corners[face[0]], corners[face[1]],
                                                   corners[face[2]]};
        if (std::ranges::any_of(of_face, [](const auto& corner) { return corner.z <= 0.0F; })) {
            continue;
        }
        std::optional<FaceStep> moved;
        visit_pixels(of_face, width, height, [&](int x, int y, float z) {
            const std::size_t pixel = static_cast<std::size_t>(y) * width + x;
            if (z >= drawn.depth[pixel]) return;
            drawn.depth[pixel] = z;
            if (steps.empty()) return;
            if (!moved) moved.emplace(mesh, face, view, steps);
            drawn.step[pixel] = moved->at(x, y);
        });
    }
    return drawn;
}

} // namespace vcarve
