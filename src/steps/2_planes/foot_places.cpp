#include "steps/2_planes/foot_places.h"

#include "base/parallel.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The points of the ground near a place that lie away from what stands over it; none if there are
/// some beneath it, so that nothing stands there.
std::vector<Near> points_outward(const Patch& ground, const Vector3d& foot, const Vector3d& outward)
{
    constexpr double kReach = 4.0;  // spacings
    constexpr double kInward = 0.3; // the same
    constexpr double kDone = -1.0;  // no box is so near
    const double spacing = ground.region->spacing;
    const double reach = kReach * spacing;
    double most = reach;
    std::vector<Near> found;
    ground.tree.visit_near(foot, {0, 0}, most, [&](std::size_t i) {
        const Vector3d way = ground.positions[i] - foot;
        const double distance = way.norm();
        if (distance > reach) return;
        if (way.dot(outward) < -kInward * spacing) most = kDone;
        found.emplace_back(distance, ground.region->points[i]);
    });
    if (most == kDone) found.clear();
    return found;
}

/// Adds the foot below a border, if there is one.
void add_foot(const Scene& scene, const NearestNeighbors& tree, const FlatParts& parts,
              const BorderPlace& border, std::vector<AddedPlace>& found)
{
    constexpr double kThere = 0.2; // spacings
    const std::uint32_t below = parts.region_of[border.seen];
    if (below == FlatParts::kNone || below == border.region) return;
    const Patch& ground = parts.patches[below];
    const double spacing = ground.region->spacing;
    const Vector3d& up = ground.region->plane.normal;
    const auto height_of = [&](const Vector3d& place) {
        return up.dot(place - ground.region->plane.center);
    };
    const double height = height_of(border.passage);
    if (std::min(height, height_of(border.position)) < spacing) return;
    const Vector3d out = border.passage - border.position;
    const Vector3d outward = (out - up.dot(out) * up).normalized();
    AddedPlace foot{
        .position = border.passage - height * up, .step = spacing, .id = kBorderPointId};

    const std::vector<Near> near = points_outward(ground, foot.position, outward);
    if (near.size() < 2) return;
    if (tree.has_nearer(foot.position, kThere * spacing)) return;
    const std::vector<std::uint32_t> beside = nearest_two(near, kRounding * spacing);
    foot.beside = {beside.front()};
    foot.track = views_showing(scene, beside, foot.position);
    std::erase_if(foot.track, [&](std::uint32_t view) {
        const Vector3d way = scene.views[view].center - foot.position;
        return up.dot(way) <= 0.0 || outward.dot(way) <= 0.0;
    });
    if (foot.track.size() >= 2) found.push_back(std::move(foot));
}

} // namespace

std::vector<AddedPlace> foot_places(const Scene& scene, const NearestNeighbors& tree,
                                    const FlatParts& parts, const std::vector<BorderPlace>& borders)
{
    const auto look = [&](std::size_t i, std::vector<AddedPlace>& found) {
        add_foot(scene, tree, parts, borders[i], found);
    };
    return parallel_collect<AddedPlace>(borders.size(), look, 256);
}

} // namespace vcarve
