#include "render/raster.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vcarve::render {

namespace {

/// A face in the camera's frame and its plane, normal . position = height.
struct FaceInCamera {
    std::array<Eigen::Vector3d, 3> corners;
    Eigen::Vector3d normal;
    double height = 0.0;
};

FaceInCamera in_camera(const TriMesh& mesh, const Face& face, const Pinhole& view)
{
    FaceInCamera result;
    for (int i = 0; i < 3; ++i) {
        result.corners[i] = view.cam_from_world * (mesh.positions[face[i]] - view.center);
    }
    const auto& [a, b, c] = result.corners;
    result.normal = (b - a).cross(c - a);
    result.height = result.normal.dot(a);
    return result;
}

/// The part of a triangle with z >= near, as a polygon of up to four corners.
std::vector<Eigen::Vector3d> clip(const std::array<Eigen::Vector3d, 3>& corners, double near)
{
    std::vector<Eigen::Vector3d> result;
    for (int i = 0; i < 3; ++i) {
        const Eigen::Vector3d& a = corners[i];
        const Eigen::Vector3d& b = corners[(i + 1) % 3];
        if (a.z() >= near) result.push_back(a);
        if ((a.z() < near) != (b.z() < near)) {
            result.push_back(a + (near - a.z()) / (b.z() - a.z()) * (b - a));
        }
    }
    return result;
}

double turn(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
    return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The range of pixels, first to last, between two positions along a row or column.
std::pair<int, int> pixels_between(double low, double high, int count)
{
    const double first = std::clamp(std::floor(low - 0.5), 0.0, static_cast<double>(count));
    const double last = std::clamp(std::ceil(high - 0.5), -1.0, count - 1.0);
    return {static_cast<int>(first), static_cast<int>(last)};
}

class DepthBuffer {
  public:
    explicit DepthBuffer(const Pinhole& view)
        : view_(view), hits_(static_cast<std::size_t>(view.width_px) * view.height_px)
    {
    }

    void draw(const FaceInCamera& face, std::uint32_t index, double near)
    {
        const std::vector<Eigen::Vector3d> polygon = clip(face.corners, near);
        for (std::size_t i = 2; i < polygon.size(); ++i) {
            fill(face, index, {image(polygon[0]), image(polygon[i - 1]), image(polygon[i])});
        }
    }

    std::vector<Hit> take() { return std::move(hits_); }

  private:
    using Triangle = std::array<Eigen::Vector2d, 3>;

    Eigen::Vector2d image(const Eigen::Vector3d& place) const
    {
        return view_.principal_px + view_.focal_px.cwiseProduct(place.head<2>() / place.z());
    }

    void fill(const FaceInCamera& face, std::uint32_t index, const Triangle& t)
    {
        const Eigen::Vector2d low = t[0].cwiseMin(t[1]).cwiseMin(t[2]);
        const Eigen::Vector2d high = t[0].cwiseMax(t[1]).cwiseMax(t[2]);
        const auto [left, right] = pixels_between(low.x(), high.x(), view_.width_px);
        const auto [top, bottom] = pixels_between(low.y(), high.y(), view_.height_px);
        const double side = turn(t[0], t[1], t[2]) < 0 ? -1.0 : 1.0;
        for (int y = top; y <= bottom; ++y) {
            for (int x = left; x <= right; ++x) {
                const Eigen::Vector2d pixel(x + 0.5, y + 0.5);
                const bool inside = side * turn(t[0], t[1], pixel) >= 0 &&
                                    side * turn(t[1], t[2], pixel) >= 0 &&
                                    side * turn(t[2], t[0], pixel) >= 0;
                if (inside) put(face, index, pixel);
            }
        }
    }

    void put(const FaceInCamera& face, std::uint32_t index, const Eigen::Vector2d& pixel)
    {
        const Eigen::Vector2d slope = (pixel - view_.principal_px).cwiseQuotient(view_.focal_px);
        const double along = face.normal.dot(slope.homogeneous());
        const double depth = face.height / along;
        if (!(depth > 0.0) || !std::isfinite(depth)) return;
        const auto x = static_cast<std::size_t>(pixel.x());
        const auto y = static_cast<std::size_t>(pixel.y());
        Hit& hit = hits_[y * view_.width_px + x];
        if (hit.face != Hit::kNoFace && hit.depth <= depth) return;
        hit = {index, along < 0.0, depth};
    }

    const Pinhole& view_;
    std::vector<Hit> hits_;
};

/// The depth of the near plane: a millionth of the depth of the farthest vertex.
double near_plane(const TriMesh& mesh, const Pinhole& view)
{
    double farthest_sq = 0.0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        farthest_sq = std::max(farthest_sq, (position - view.center).squaredNorm());
    }
    return 1e-6 * std::sqrt(farthest_sq);
}

} // namespace

Eigen::Vector3d Pinhole::ray(const Eigen::Vector2d& pixel) const
{
    const Eigen::Vector2d slope = (pixel - principal_px).cwiseQuotient(focal_px);
    return cam_from_world.transpose() * slope.homogeneous();
}

Pinhole enlarged(const Pinhole& view, int factor)
{
    Pinhole result = view;
    result.focal_px *= factor;
    result.principal_px *= factor;
    result.width_px *= factor;
    result.height_px *= factor;
    return result;
}

std::vector<Hit> rasterize(const TriMesh& mesh, const Pinhole& view)
{
    DepthBuffer buffer(view);
    const double near = near_plane(mesh, view);
    for (std::uint32_t i = 0; i < mesh.faces.size(); ++i) {
        buffer.draw(in_camera(mesh, mesh.faces[i], view), i, near);
    }
    return buffer.take();
}

Eigen::Vector3d face_normal(const TriMesh& mesh, std::uint32_t face)
{
    const auto& [a, b, c] = mesh.faces[face];
    const Eigen::Vector3d& p = mesh.positions[a];
    return (mesh.positions[b] - p).cross(mesh.positions[c] - p).normalized();
}

Pinhole looking_at(const Lens& lens, const Eigen::Vector3d& center, const Eigen::Vector3d& target)
{
    Pinhole view;
    view.center = center;
    view.focal_px.setConstant(lens.focal_px);
    view.principal_px = {lens.width_px / 2.0, lens.height_px / 2.0};
    view.width_px = lens.width_px;
    view.height_px = lens.height_px;
    const Eigen::Vector3d ahead = (target - center).normalized();
    const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
    view.cam_from_world << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    return view;
}

void add_arc(std::vector<Pinhole>& views, const Lens& lens, const Arc& arc)
{
    for (int i = 0; i < arc.count; ++i) {
        const double turn_rad = (arc.first_deg + arc.step_deg * i) * std::numbers::pi / 180.0;
        const Eigen::Vector3d center(arc.target.x() + arc.radius * std::sin(turn_rad),
                                     arc.target.y() - arc.radius * std::cos(turn_rad), arc.height);
        views.push_back(looking_at(lens, center, arc.target));
    }
}

} // namespace vcarve::render
