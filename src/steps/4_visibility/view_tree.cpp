#include "steps/4_visibility/view_tree.h"

#include "model/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace vcarve {

using Eigen::Vector3d;

namespace {

/// How far off its axis a camera shows things at most, found along the edge of its images; pi where
/// it is not known.
double widest_angle(const Camera& camera)
{
    constexpr int kSteps = 16; // a side
    constexpr double kMargin = 1.1;
    double widest = 0.0;
    for (int i = 0; i < 4 * kSteps; ++i) {
        const double along = static_cast<double>(i % kSteps) / kSteps;
        const std::array<Eigen::Vector2d, 4> edge = {
            {{along, 0.0}, {1.0, along}, {1.0 - along, 1.0}, {0.0, 1.0 - along}}};
        const Eigen::Vector2d& at = edge[static_cast<std::size_t>(i / kSteps)];
        const Eigen::Vector2d size_px(camera.width_px, camera.height_px);
        const auto way = ray(camera, at.cwiseProduct(size_px));
        if (!way) return std::numbers::pi;
        widest = std::max(widest, kMargin * std::acos(std::clamp(way->z(), -1.0, 1.0)));
    }
    return std::min(widest, std::numbers::pi);
}

double angle_between(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

} // namespace

ViewTree::ViewTree(const Scene& scene) : order_(scene.views.size())
{
    std::iota(order_.begin(), order_.end(), 0U);
    if (!order_.empty())
        add_node(scene, angles_of(scene), 0, static_cast<std::uint32_t>(order_.size()));
}

std::vector<double> ViewTree::angles_of(const Scene& scene)
{
    std::vector<double> widest(scene.cameras.size());
    std::ranges::transform(scene.cameras, widest.begin(), widest_angle);
    std::vector<double> angles(scene.views.size());
    std::ranges::transform(scene.views, angles.begin(),
                           [&](const View& view) { return widest[view.camera]; });
    return angles;
}

/// Adds the node of a run of views and all below it.
void ViewTree::add_node(const Scene& scene, const std::vector<double>& angles, std::uint32_t first,
                        std::uint32_t last)
{
    constexpr std::uint32_t kFew = 4;
    Eigen::AlignedBox3d box;
    Vector3d axis = Vector3d::Zero();
    const auto axis_of = [&](std::uint32_t view) -> Vector3d {
        return scene.views[view].cam_from_world.conjugate() * Vector3d::UnitZ();
    };
    for (std::uint32_t i = first; i < last; ++i) {
        box.extend(scene.views[order_[i]].center);
        axis += axis_of(order_[i]);
    }
    double angle = 0.0;
    for (std::uint32_t i = first; i < last; ++i) {
        angle = std::max(angle, angles[order_[i]] + angle_between(axis, axis_of(order_[i])));
    }
    const std::size_t number = nodes_.size();
    nodes_.push_back({box.center(), 0.5 * box.sizes(), first, last, 0, axis, angle});
    if (last - first <= kFew) return;
    int longest = 0;
    box.sizes().maxCoeff(&longest);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double at_a = scene.views[a].center[longest];
                         const double at_b = scene.views[b].center[longest];
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    add_node(scene, angles, first, middle);
    nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
    add_node(scene, angles, middle, last);
}

bool ViewTree::is_out_of_sight(const Node& node, const Vector3d& place)
{
    if (!(node.angle < std::numbers::pi)) return false;
    const Vector3d way = place - node.middle;
    const double radius = node.half.norm();
    const double distance = way.norm();
    if (distance <= radius) return false;
    return angle_between(way, node.axis) > node.angle + std::asin(radius / distance);
}

ViewTree::Side ViewTree::side_of(const Node& node, const Vector3d& place, const Vector3d& normal,
                                 double length)
{
    constexpr double kRounding = 1e-11;
    const Vector3d way = node.middle - place;
    const double slack = normal.cwiseAbs().dot(node.half) +
                         kRounding * length * (way.cwiseAbs() + node.half + place.cwiseAbs()).sum();
    const double height = normal.dot(way);
    if (height > slack) return Side::before;
    return height < -slack ? Side::behind : Side::unclear;
}

ViewTree::Side ViewTree::side_of_facet(const TetMesh& cells, const CellFacet& facet,
                                       const Vector3d& place, const Node& node)
{
    const auto& [a, b, c] = kFacetCorners[facet.slot];
    const auto& vertices = cells.cells[facet.cell].vertices;
    const Vector3d& from = cells.positions[vertices[a]];
    const Vector3d one = cells.positions[vertices[c]] - from;
    const Vector3d other = cells.positions[vertices[b]] - from;
    return side_of(node, place, one.cross(other), one.cwiseAbs().sum() * other.cwiseAbs().sum());
}

std::optional<CellFacet> ViewTree::exit_of(const TetMesh& cells, const CellFacet& entered,
                                           const Vector3d& place, const Node& node)
{
    const Cell& cell = cells.cells[entered.cell];
    if (cell.is_infinite()) return std::nullopt;
    const auto& corners = kFacetCorners[entered.slot];
    const Vector3d tip = cells.positions[cell.vertices[entered.slot]] - place;
    const double tip_length = tip.cwiseAbs().sum();
    // From behind the tip the corners run counter-clockwise around the way there.
    std::array<Side, 3> sides{};
    for (int i = 0; i < 3; ++i) {
        const Vector3d corner = cells.positions[cell.vertices[corners[i]]] - place;
        sides[i] = side_of(node, place, tip.cross(corner), tip_length * corner.cwiseAbs().sum());
    }
    for (int i = 0; i < 3; ++i) {
        if (sides[i] != Side::before || sides[(i + 1) % 3] != Side::behind) continue;
        const CellFacet ahead{entered.cell, corners[(i + 2) % 3]};
        const bool is_beyond =
            side_of_facet(cells, ahead, cells.positions[cell.vertices[corners[i]]], node) ==
            Side::before;
        return is_beyond ? std::optional(ahead) : std::nullopt;
    }
    return std::nullopt;
}

} // namespace vcarve
