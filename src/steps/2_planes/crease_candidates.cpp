#include "base/parallel.h"
#include "geometry/point_tree.h"
#include "steps/2_planes/candidates.h"

#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

Box grown(const Box& box, double by)
{
    return {box.low.array() - by, box.high.array() + by};
}

using PlanePair = std::array<std::uint32_t, 2>;

/// The pairs of regions whose bounding boxes meet if grown by `reach` spacings, ascending.
std::vector<PlanePair> near_pairs(const PlanarRegions& planes, double reach)
{
    using Boxed = CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t>;
    std::vector<Boxed> boxes;
    for (std::uint32_t i = 0; i < planes.regions.size(); ++i) {
        const Box box = grown(planes.regions[i].tree.box(), reach * planes.regions[i].spacing);
        boxes.emplace_back(CGAL::Bbox_3(box.low.x(), box.low.y(), box.low.z(), box.high.x(),
                                        box.high.y(), box.high.z()),
                           i);
    }
    std::vector<PlanePair> pairs;
    CGAL::box_self_intersection_d(boxes.begin(), boxes.end(), [&](const Boxed& a, const Boxed& b) {
        pairs.push_back({std::min(a.info(), b.info()), std::max(a.info(), b.info())});
    });
    std::ranges::sort(pairs);
    return pairs;
}

/// A line through a point, with a direction.
struct Line {
    Vector3d origin;
    Vector3d direction; ///< unit

    double along(const Vector3d& place) const { return direction.dot(place - origin); }
    Vector3d off(const Vector3d& place) const { return place - origin - along(place) * direction; }
};

/// The intersection of two planes that are not parallel.
Line intersection(const Plane& a, const Plane& b)
{
    const Vector3d middle = 0.5 * (a.center + b.center);
    const double cosine = a.normal.dot(b.normal);
    const double height_a = a.height_of(middle);
    const double height_b = b.height_of(middle);
    const Vector3d way =
        (height_a - cosine * height_b) * a.normal + (height_b - cosine * height_a) * b.normal;
    return {middle - way / (1.0 - cosine * cosine), a.normal.cross(b.normal).normalized()};
}

/// A lower bound of the distance between a box and a line.
double least_distance(const Box& box, const Line& line)
{
    const Vector3d middle = 0.5 * (box.low + box.high);
    return line.off(middle).norm() - 0.5 * (box.high - box.low).norm();
}

/// A point of a region near the line.
struct Support {
    double along; ///< coordinate on the line
    double high;  ///< height over the plane of the other region
};

/// The intersection of two regions.
class Crease {
  public:
    Crease(const Scene& scene, const PlanarRegions& planes, const PlanePair& pair, double reach)
        : scene_(scene),
          planes_(planes),
          pair_(pair),
          regions_({&planes.regions[pair[0]], &planes.regions[pair[1]]}),
          line_(intersection(regions_[0]->plane, regions_[1]->plane)),
          spacing_(std::max(regions_[0]->spacing, regions_[1]->spacing)),
          reach_(reach)
    {
    }

    void add_candidates(std::vector<Candidate>& found) const
    {
        constexpr double kStep = 0.7; // spacings
        const std::vector<Support> a = supports(0);
        const std::vector<Support> b = supports(1);
        if (a.empty() || b.empty()) return;
        const bool stands_out = total_height(a) + total_height(b) <= 0.0;
        const double step = kStep * spacing_;
        const double low = std::max(a.front().along, b.front().along);
        const double high = std::min(a.back().along, b.back().along);
        const double last = std::floor(high / step + kRounding);
        constexpr double kMost = 1e15; // beyond, doubles do not distinguish positions
        if (!(std::max(std::abs(low), std::abs(high)) < kMost * step)) return;
        for (double i = std::ceil(low / step - kRounding); i <= last; ++i) {
            i = std::max({i, first_near(a, i, step), first_near(b, i, step)});
            if (!are_to_both_sides(a, i * step) || !are_to_both_sides(b, i * step)) continue;
            found.push_back({.position = place_at(i, step),
                             .kind = PointKind::crease,
                             .step = step,
                             .regions = pair_,
                             .stands_out = stands_out});
            add_strip(0, found.back());
            add_strip(1, found.back());
        }
    }

  private:
    /// The points of one region near the line and the box of the other region, sorted along it.
    std::vector<Support> supports(std::size_t side) const
    {
        const PlanarRegion& region = *regions_[side];
        const PlanarRegion& other = *regions_[1 - side];
        const Box around = grown(other.tree.box(), reach_ * spacing_);
        const auto bound = [&](const Box& box) {
            return distance_between(box, around) > 0.0 ? std::numeric_limits<double>::infinity()
                                                       : least_distance(box, line_);
        };
        std::vector<Support> found;
        region.tree.visit_excluding({0, 0}, reach_ * region.spacing, bound, [&](std::size_t i) {
            const Vector3d& position = region.positions[i];
            const double spacing = std::min(region.spacing, planes_.spacings[region.points[i]]);
            if (line_.off(position).norm() <= reach_ * spacing)
                found.push_back({line_.along(position), other.plane.height_of(position)});
        });
        std::ranges::sort(found, {}, [](const Support& support) {
            return std::pair(support.along, support.high);
        });
        return found;
    }

    static double total_height(const std::vector<Support>& supports)
    {
        double sum = 0.0;
        for (const Support& support : supports) {
            sum += support.high;
        }
        return sum;
    }

    /// A lower bound of the number of the next position near a support, which may be far away.
    double first_near(const std::vector<Support>& supports, double i, double step) const
    {
        const double within = reach_ * spacing_;
        const auto next =
            std::ranges::lower_bound(supports, i * step - within, {}, &Support::along);
        return next == supports.end() ? i : std::floor((next->along - within) / step);
    }

    /// Whether supports are within the reach in both directions along the line.
    bool are_to_both_sides(const std::vector<Support>& supports, double along) const
    {
        const double within = reach_ * spacing_;
        const double slack = kRounding * within;
        const auto first = std::ranges::lower_bound(supports, along - within, {}, &Support::along);
        const auto last = std::ranges::upper_bound(supports, along + within, {}, &Support::along);
        return first != last && first->along <= along + slack &&
               std::prev(last)->along >= along - slack;
    }

    /// The i-th position, slightly off the line and both planes by pseudorandom amounts.
    Vector3d place_at(double i, double step) const
    {
        constexpr std::array<double, 2> kIrrational = {0.6180339887, 0.4142135624};
        const std::array<double, 2> turns = {kIrrational[0] * i * i, kIrrational[1] * i * i * i};
        Vector3d place = line_.origin + i * step * line_.direction;
        for (std::size_t side = 0; side < 2; ++side) {
            const double off = 2.0 * (turns[side] - std::floor(turns[side])) - 1.0;
            place += kOffPlane * step * off * regions_[side]->plane.normal;
        }
        return place;
    }

    /// Adds the surface between a candidate and its two nearest points of one region. The strip is
    /// as wide as the step. It runs towards the mean of these points, as far as the one nearest to
    /// the line. Its two ends are omitted, because planes are inexact.
    void add_strip(std::size_t side, Candidate& candidate) const
    {
        constexpr double kLeftOut = 0.1; // of its length, at either end
        Vector3d away = Vector3d::Zero();
        double length = std::numeric_limits<double>::infinity();
        for (const std::uint32_t point : regions_[side]->nearest(candidate.position, 2)) {
            const Vector3d off = line_.off(scene_.positions[point]);
            away += off;
            length = std::min(length, off.norm());
        }
        const Vector3d half = 0.5 * candidate.step * line_.direction;
        const Vector3d whole = length * away.normalized();
        const Vector3d begin = candidate.position + kLeftOut * whole;
        const Vector3d end = candidate.position + (1.0 - kLeftOut) * whole;
        candidate.surface.push_back({begin - half, begin + half, end + half});
        candidate.surface.push_back({end + half, end - half, begin - half});
    }

    const Scene& scene_;
    const PlanarRegions& planes_;
    PlanePair pair_;
    std::array<const PlanarRegion*, 2> regions_;
    Line line_;
    double spacing_; ///< the larger of both regions
    double reach_;
};

} // namespace

std::vector<Candidate> crease_candidates(const Scene& scene, const PlanarRegions& planes,
                                         double reach, const Progress& progress)
{
    constexpr double kMostCosine = 0.866; // of 30 degrees
    const std::vector<PlanePair> pairs = near_pairs(planes, reach);
    const auto look = [&](std::size_t i, std::vector<Candidate>& found) {
        const Plane& a = planes.regions[pairs[i][0]].plane;
        const Plane& b = planes.regions[pairs[i][1]].plane;
        if (std::abs(a.normal.dot(b.normal)) <= kMostCosine)
            Crease(scene, planes, pairs[i], reach).add_candidates(found);
    };
    return parallel_collect<Candidate>(pairs.size(), progress, look, 64);
}

} // namespace vcarve
