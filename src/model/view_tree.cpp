#include "model/view_tree.h"

#include "model/camera.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace vcarve {

using Eigen::Vector3d;

namespace {

/// The largest angle to the axis that a camera shows, sampled along the edge of its image; pi if
/// unknown.
double widest_angle(const Camera& camera)
{
    constexpr int kSteps = 16; // per side
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

ViewTree::ViewTree(const Scene& scene) : centers_(scene.views.size())
{
    std::ranges::transform(scene.views, centers_.begin(), &View::center);
    for (std::uint32_t view = 0; view < centers_.size(); ++view) {
        if (centers_[view].allFinite()) order_.push_back(view);
    }
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

/// Adds the node of a range of views, and its descendants.
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
        box.extend(centers_[order_[i]]);
        axis += axis_of(order_[i]);
    }
    double angle = 0.0;
    for (std::uint32_t i = first; i < last; ++i) {
        angle = std::max(angle, angles[order_[i]] + angle_between(axis, axis_of(order_[i])));
    }
    angle = std::min(angle, std::numbers::pi);
    const std::size_t number = nodes_.size();
    nodes_.push_back({box.center(), 0.5 * box.sizes(), first, last, 0, axis.normalized(),
                      std::cos(angle), std::sin(angle)});
    if (last - first <= kFew) return;
    int longest = 0;
    box.sizes().maxCoeff(&longest);
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(order_.begin() + first, order_.begin() + middle, order_.begin() + last,
                     [&](std::uint32_t a, std::uint32_t b) {
                         const double at_a = centers_[a][longest];
                         const double at_b = centers_[b][longest];
                         return at_a < at_b || (at_a == at_b && a < b);
                     });
    add_node(scene, angles, first, middle);
    nodes_[number].right = static_cast<std::uint32_t>(nodes_.size());
    add_node(scene, angles, middle, last);
}

bool ViewTree::is_out_of_view(const Node& node, const Vector3d& place)
{
    const Vector3d way = place - node.middle;
    const double radius = node.half.norm();
    const double distance = way.norm();
    if (!(distance > radius)) return false;
    // Widen the cone by half the angle that the box subtends at `place`.
    const double half_sine = radius / distance;
    const double half_cosine = std::sqrt(1.0 - half_sine * half_sine);
    const double wide_sine = node.sine * half_cosine + node.cosine * half_sine;
    const double wide_cosine = node.cosine * half_cosine - node.sine * half_sine;
    return wide_sine > 0.0 && way.dot(node.axis) < distance * wide_cosine;
}

bool ViewTree::is_behind(const Node& node, const Vector3d& place, const Vector3d& normal)
{
    constexpr double kRounding = 1e-11;
    const Vector3d way = node.middle - place;
    const double slack = normal.cwiseAbs().dot(
        node.half + kRounding * (way.cwiseAbs() + node.half + place.cwiseAbs()));
    return normal.dot(way) < -slack;
}

void ViewTree::add(std::size_t number, const Vector3d& place, const Vector3d& normal,
                   std::vector<Near>& queue) const
{
    const Node& node = nodes_[number];
    if (is_out_of_view(node, place) || is_behind(node, place, normal)) return;
    const Vector3d gap = (place - node.middle).cwiseAbs() - node.half;
    queue.push_back({gap.cwiseMax(0.0).norm(), number});
    std::ranges::push_heap(queue, std::greater<>());
}

void ViewTree::add_parts(std::size_t number, const Vector3d& place, const Vector3d& normal,
                         std::vector<Near>& queue) const
{
    const Node& node = nodes_[number];
    if (node.right != 0) {
        add(number + 1, place, normal, queue);
        add(node.right, place, normal, queue);
        return;
    }
    for (std::uint32_t i = node.first; i < node.last; ++i) {
        queue.push_back({(centers_[order_[i]] - place).norm(), nodes_.size() + order_[i]});
        std::ranges::push_heap(queue, std::greater<>());
    }
}

} // namespace vcarve
