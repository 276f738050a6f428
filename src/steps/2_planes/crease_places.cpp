#include "steps/2_planes/crease_places.h"

#include "base/parallel.h"
#include "geometry/box.h"
#include "geometry/point_tree.h"

#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <span>
#include <tuple>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// How far apart the points of a crease stand, in spacings of the regions that meet there.
constexpr double kStep = 0.7;

Box grown(const Box& box, double by)
{
    return {box.low.array() - by, box.high.array() + by};
}

/// Two patches by their places among all.
using Pair = std::array<std::uint32_t, 2>;

/// The pairs of patches that lie no farther apart than `reach` of their spacings, ascending.
std::vector<Pair> near_pairs(const std::vector<Patch>& patches, double reach)
{
    using Boxed = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Boxed> boxes;
    for (std::uint32_t i = 0; i < patches.size(); ++i) {
        const Box box = grown(patches[i].tree.box(), reach * patches[i].region->spacing);
        boxes.emplace_back(CGAL::Bbox_3(box.low.x(), box.low.y(), box.low.z(), box.high.x(),
                                        box.high.y(), box.high.z()),
                           i);
    }
    std::vector<Pair> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Boxed& a, const Boxed& b) {
        pairs.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
    });
    std::ranges::sort(pairs);
    return pairs;
}

/// A line, by a point on it and its direction.
struct Line {
    Vector3d origin;
    Vector3d direction; ///< unit

    Vector3d at(double along) const { return origin + along * direction; }
};

/// Where two planes meet that are not parallel.
Line intersection(const Plane& a, const Plane& b)
{
    const Vector3d middle = 0.5 * (a.center + b.center);
    const double cosine = a.normal.dot(b.normal);
    const double height_a = a.normal.dot(a.center - middle);
    const double height_b = b.normal.dot(b.center - middle);
    const double sine_sq = 1.0 - cosine * cosine;
    return {middle + ((height_a - cosine * height_b) * a.normal +
                      (height_b - cosine * height_a) * b.normal) /
                         sine_sq,
            a.normal.cross(b.normal).normalized()};
}

/// No more than the distance of any place in a box from a line.
double least_distance(const Box& box, const Line& line)
{
    const Vector3d way = 0.5 * (box.low + box.high) - line.origin;
    return way.cross(line.direction).norm() - 0.5 * (box.high - box.low).norm();
}

/// The foot of the perpendicular from a point of a region to a line.
struct Foot {
    double along; ///< the line, from its origin
    double off;   ///< from the line to the point
    std::uint32_t point;
};

/// Finds where the flat parts of a scene meet.
class Creases {
  public:
    Creases(const Scene& scene, const NearestNeighbors& tree, const FlatParts& parts, double reach)
        : scene_(scene), tree_(tree), parts_(parts), reach_(reach)
    {
    }

    /// The places along all creases, in an order that does not depend on the threads.
    std::vector<CreasePlace> places(const Progress& progress) const
    {
        const std::vector<Pair> pairs = near_pairs(parts_.patches, reach_);
        const auto look = [&](std::size_t i, std::vector<CreasePlace>& found) {
            add_places(pairs[i], found);
        };
        return parallel_collect<CreasePlace>(pairs.size(), progress, look, 64);
    }

  private:
    /// What meets at a crease.
    struct Crease {
        Pair pair;
        std::array<const PlanarRegion*, 2> regions;
        Line line = {};
        double spacing = 0.0;                       ///< the larger one
        std::array<std::vector<Foot>, 2> feet = {}; ///< of either's points near the line, along it
        bool stands_out = false;                    ///< as the edge of a box, not as a wall's foot
    };

    void add_places(const Pair& pair, std::vector<CreasePlace>& found) const
    {
        constexpr double kMostCosine = 0.866; // of 30 degrees
        Crease crease{.pair = pair,
                      .regions = {parts_.patches[pair[0]].region, parts_.patches[pair[1]].region}};
        const Plane& a = crease.regions[0]->plane;
        const Plane& b = crease.regions[1]->plane;
        if (std::abs(a.normal.dot(b.normal)) > kMostCosine) return;
        crease.line = intersection(a, b);
        crease.spacing = std::max(crease.regions[0]->spacing, crease.regions[1]->spacing);
        crease.feet = {feet(crease, 0), feet(crease, 1)};
        if (crease.feet[0].empty() || crease.feet[1].empty()) return;
        crease.stands_out = height_of(crease, 0) + height_of(crease, 1) <= 0.0;
        const double step = kStep * crease.spacing;
        const auto low =
            std::ranges::max(crease.feet[0].front().along, crease.feet[1].front().along);
        const auto high =
            std::ranges::min(crease.feet[0].back().along, crease.feet[1].back().along);
        const double last = std::floor(high / step + kRounding);
        for (double i = std::ceil(low / step - kRounding); i <= last; ++i) {
            add_place(crease, {{.position = place_at(crease, i, step), .step = step}}, i * step,
                      found);
        }
    }

    /// The i-th place, a little off the line, to either side of both planes, as i² and i³ tell: of
    /// points on one line along a hull rounding would tell which cells there are.
    static Vector3d place_at(const Crease& crease, double i, double step)
    {
        constexpr double kOff = 1e-3; // of a step, at most
        constexpr std::array<double, 2> kIrrational = {0.6180339887, 0.4142135624};
        const std::array<double, 2> turns = {kIrrational[0] * i * i, kIrrational[1] * i * i * i};
        Vector3d place = crease.line.at(i * step);
        for (std::size_t side = 0; side < 2; ++side) {
            const double off = 2.0 * (turns[side] - std::floor(turns[side])) - 1.0;
            place += kOff * step * off * crease.regions[side]->plane.normal;
        }
        return place;
    }

    /// Of the points of one region those near the line where the other region is near, too.
    std::vector<Foot> feet(const Crease& crease, std::size_t side) const
    {
        const Patch& patch = parts_.patches[crease.pair[side]];
        const Box other =
            grown(parts_.patches[crease.pair[1 - side]].tree.box(), reach_ * crease.spacing);
        std::vector<Foot> found;
        const auto look_at = [&](std::size_t i) {
            const Vector3d way = patch.positions[i] - crease.line.origin;
            const double along = way.dot(crease.line.direction);
            const double off = (way - along * crease.line.direction).norm();
            const std::uint32_t point = patch.region->points[i];
            const double spacing = std::min(patch.region->spacing, parts_.planes.spacings[point]);
            if (off <= reach_ * spacing) found.push_back({along, off, point});
        };
        const double most = reach_ * patch.region->spacing;
        const auto bound = [&](const Box& box) {
            return distance_between(box, other) > 0.0 ? std::numeric_limits<double>::infinity()
                                                      : least_distance(box, crease.line);
        };
        patch.tree.visit_foreign({0, 0}, most, bound, look_at);
        std::ranges::sort(found, {},
                          [](const Foot& foot) { return std::tie(foot.along, foot.point); });
        return found;
    }

    /// How high one region's points near the crease lie over the plane of the other, all together.
    double height_of(const Crease& crease, std::size_t side) const
    {
        double sum = 0.0;
        for (const Foot& foot : crease.feet[side]) {
            sum += crease.regions[1 - side]->plane.normal.dot(scene_.positions[foot.point] -
                                                              crease.line.origin);
        }
        return sum;
    }

    void add_place(const Crease& crease, CreasePlace place, double along,
                   std::vector<CreasePlace>& found) const
    {
        std::array<std::span<const Foot>, 2> near;
        for (std::size_t side = 0; side < 2; ++side) {
            near[side] = feet_around(crease.feet[side], along, reach_ * crease.spacing);
            if (near[side].empty()) return;
        }
        if (!is_between(crease, place)) return;
        std::array<std::vector<std::uint32_t>, 2> beside;
        for (std::size_t side = 0; side < 2; ++side) {
            beside[side] = nearest(near[side], along, kRounding * crease.spacing);
        }
        place.beside = {beside[0].front()};
        place.track = views_of(crease, place.position, beside);
        if (place.track.size() < 2) return;
        for (std::size_t side = 0; side < 2; ++side) {
            place.strips[side] = strip(crease, place, beside[side]);
        }
        found.push_back(std::move(place));
    }

    /// The feet within so far of a place along the line; none if they are not to both sides of it.
    static std::span<const Foot> feet_around(const std::vector<Foot>& feet, double along,
                                             double within)
    {
        const double slack = kRounding * within;
        const auto first = std::ranges::lower_bound(feet, along - within, {}, &Foot::along);
        const auto last = std::ranges::upper_bound(feet, along + within, {}, &Foot::along);
        if (first == last || first->along > along + slack) return {};
        if (std::prev(last)->along < along - slack) return {};
        return {first, last};
    }

    /// The points of the two feet next to a place, and of those as near, up to the slack.
    static std::vector<std::uint32_t> nearest(std::span<const Foot> feet, double along,
                                              double slack)
    {
        std::vector<Near> near(feet.size());
        std::ranges::transform(feet, near.begin(), [&](const Foot& foot) {
            return Near(std::hypot(foot.along - along, foot.off), foot.point);
        });
        return nearest_two(std::move(near), slack);
    }

    /// The surface that there would be between a place and the points of one side next to it: as
    /// wide as its step, towards their middle, up to the one nearest to the line. Some is left out
    /// where it begins and ends, since planes are a little off.
    Strip strip(const Crease& crease, const CreasePlace& place,
                const std::vector<std::uint32_t>& points) const
    {
        constexpr double kLeftOut = 0.1; // of its length, at either end
        Vector3d away = Vector3d::Zero();
        double length = std::numeric_limits<double>::infinity();
        for (const std::uint32_t point : points) {
            const Vector3d way = scene_.positions[point] - crease.line.origin;
            const Vector3d off = way - way.dot(crease.line.direction) * crease.line.direction;
            away += off;
            length = std::min(length, off.norm());
        }
        const Vector3d half = 0.5 * place.step * crease.line.direction;
        const Vector3d whole = length * away.normalized();
        const Vector3d begin = place.position + kLeftOut * whole;
        const Vector3d end = place.position + (1.0 - kLeftOut) * whole;
        return {begin - half, begin + half, end + half, end - half};
    }

    /// Whether the points around a place are those of the two regions, and none is at the place.
    bool is_between(const Crease& crease, const CreasePlace& place) const
    {
        constexpr double kThere = 0.3; // of a step
        constexpr std::size_t kLook = 8;
        constexpr std::ptrdiff_t kMost = 5;
        std::vector<NearestNeighbors::Neighbor> nearest;
        tree_.find(place.position, kLook, nearest);
        const auto is_theirs = [&](const NearestNeighbors::Neighbor& near) {
            const std::uint32_t region = parts_.region_of[near.point];
            return region == crease.pair[0] || region == crease.pair[1];
        };
        const double there = kThere * place.step;
        return nearest.front().distance_sq >= there * there &&
               std::ranges::count_if(nearest, is_theirs) >= kMost;
    }

    /// The views of some points that can see a place of the crease.
    std::vector<std::uint32_t>
    views_of(const Crease& crease, const Vector3d& place,
             const std::array<std::vector<std::uint32_t>, 2>& beside) const
    {
        std::vector<std::uint32_t> points = beside[0];
        std::ranges::copy(beside[1], std::back_inserter(points));
        std::vector<std::uint32_t> views = views_showing(scene_, points, place);
        std::erase_if(views, [&](std::uint32_t view) {
            const auto is_before = [&](const PlanarRegion* region) {
                return region->plane.normal.dot(scene_.views[view].center - place) > 0.0;
            };
            return crease.stands_out ? std::ranges::none_of(crease.regions, is_before)
                                     : !std::ranges::all_of(crease.regions, is_before);
        });
        return views;
    }

    const Scene& scene_;
    const NearestNeighbors& tree_;
    const FlatParts& parts_;
    double reach_;
};

} // namespace

std::vector<CreasePlace> crease_places(const Scene& scene, const NearestNeighbors& tree,
                                       const FlatParts& parts, double reach,
                                       const Progress& progress)
{
    return Creases(scene, tree, parts, reach).places(progress);
}

} // namespace vcarve
