#include "render/shade.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace vcarve::render {

namespace {

constexpr int kSamplesASide = 3;
const Eigen::Array3f kBackground(255.0F, 255.0F, 255.0F);
const Eigen::Array3f kPlain(200.0F, 200.0F, 205.0F);
const Eigen::Array3f kBack(255.0F, 0.0F, 255.0F);
const Eigen::Array3f kEdge(30.0F, 30.0F, 30.0F);

Eigen::Array3f own_color(const TriMesh& mesh, std::uint32_t face, const Eigen::Vector3d& place)
{
    const Eigen::Vector3f shares = vertex_shares(mesh, face, place).cast<float>();
    Eigen::Array3f sum = Eigen::Array3f::Zero();
    for (int i = 0; i < 3; ++i) {
        const Color& color = mesh.colors[mesh.faces[face][i]];
        sum += shares[i] * Eigen::Array3f(color[0], color[1], color[2]);
    }
    return sum;
}

Eigen::Array3f sample_color(const TriMesh& mesh, const Hit& hit, const Eigen::Vector3d& place,
                            const ShadeOptions& options)
{
    if (!hit.front) return kBack;
    const bool colored = options.use_colors && !mesh.colors.empty();
    return colored ? own_color(mesh, hit.face, place) : kPlain;
}

/// The middle and the half-diagonal of the box around the mesh.
std::pair<Eigen::Vector3d, double> extent(const TriMesh& mesh)
{
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    return {box.center(), box.diagonal().norm() / 2.0};
}

} // namespace

Picture shade(const TriMesh& mesh, const Pinhole& view, const ShadeOptions& options)
{
    const Pinhole fine = enlarged(view, kSamplesASide);
    const std::vector<Hit> hits = rasterize(mesh, fine);
    Picture picture{fine.width_px, fine.height_px, {}};
    picture.pixels.assign(hits.size(), kBackground);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits[i];
        if (hit.face == Hit::kNoFace) continue;
        const int x = static_cast<int>(i % fine.width_px);
        const int y = static_cast<int>(i / fine.width_px);
        const Eigen::Vector3d ray = fine.ray({x + 0.5, y + 0.5});
        const Eigen::Vector3d place = fine.center + hit.depth * ray;

        // Light comes from the camera, so what is seen at a slant is darker.
        const double facing = std::abs(face_normal(mesh, hit.face).dot(ray.normalized()));
        const auto light = static_cast<float>(0.35 + 0.65 * facing);
        picture.pixels[i] = light * sample_color(mesh, hit, place, options);

        // A sample is on an edge if the next one to the right or below shows another face.
        const bool right = x + 1 < fine.width_px && hits[i + 1].face != hit.face;
        const bool below = y + 1 < fine.height_px && hits[i + fine.width_px].face != hit.face;
        if (options.draw_edges && (right || below)) picture.pixels[i] = kEdge;
    }
    return shrunk(picture, kSamplesASide);
}

Pinhole view_of_whole(const TriMesh& mesh, const Look& look, int width_px)
{
    const auto [middle, radius] = extent(mesh);
    const double half_angle_rad = 22.5 * std::acos(-1.0) / 180.0;
    Pinhole view;
    view.width_px = width_px;
    view.height_px = width_px * 3 / 4;
    view.focal_px.setConstant(view.height_px / 2.0 / std::tan(half_angle_rad));
    view.principal_px = {view.width_px / 2.0, view.height_px / 2.0};
    view.center = middle + look.from.normalized() * radius / std::sin(half_angle_rad);

    // Rows are the camera's axes: right, down, ahead.
    const Eigen::Vector3d ahead = -look.from.normalized();
    const Eigen::Vector3d right = ahead.cross(look.up).normalized();
    view.cam_from_world << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    return view;
}

} // namespace vcarve::render
