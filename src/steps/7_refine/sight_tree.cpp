#include "steps/7_refine/sight_tree.h"

#include "base/parallel_invoke.h"
#include "geometry/predicates.h"
#include "geometry/triangle.h"

#include <algorithm>
#include <utility>

namespace vcarve {
namespace {

using Eigen::Vector3d;

constexpr std::size_t kLeafSights = 8;
constexpr std::size_t kParallelSights = 1U << 14U;
/// How much more an extent counts where sights begin, next to the surface: triangles are there.
constexpr double kBeginWeight = 2.0;

std::size_t middle_of(std::size_t first, std::size_t last)
{
    return first + (last - first) / 2;
}

std::size_t num_nodes(std::size_t sights)
{
    std::size_t nodes = 1;
    for (; sights > kLeafSights; sights -= sights / 2) {
        nodes = 2 * nodes + 1;
    }
    return nodes;
}

/// The stretch of t in [0, 1] where c + s t <= 0 is cut out of `from` .. `to`.
void clip(double c, double s, double& from, double& to)
{
    if (s > 0.0) {
        to = std::min(to, -c / s);
    } else if (s < 0.0) {
        from = std::max(from, -c / s);
    } else if (c > 0.0) {
        to = -1.0;
    }
}

} // namespace

/// A triangle, and what rules most sights out at once. Tolerances only make it look at more.
struct SightTree::Query {
    const std::array<Vector3d, 3>& triangle;
    const Visitor& visit;
    Box box;
    Vector3d normal;
    double height; ///< of the plane along `normal`
    double tolerance;

    Query(const std::array<Vector3d, 3>& t, const Visitor& visitor, double extent)
        : triangle(t), visit(visitor), box(t[0])
    {
        constexpr double kRounding = 1e-12;
        box.extend(t[1]).extend(t[2]);
        const double reach = kRounding * std::max(extent, box.min().cwiseAbs().maxCoeff() +
                                                              box.max().cwiseAbs().maxCoeff());
        box.min().array() -= reach;
        box.max().array() += reach;
        normal = scaled_normal(t[0], t[1], t[2]);
        height = normal.dot(t[0]);
        // The cross product's own rounding, times the lever it acts on.
        const double longest = std::max((t[1] - t[0]).norm(), (t[2] - t[0]).norm());
        tolerance = 4.0 * (normal.lpNorm<1>() + longest * longest) * reach;
    }

    /// Whether, on the way from one box to the other, there is a place that touches the plane and
    /// the box of the triangle.
    bool may_meet(const Box& begins, const Box& ends) const
    {
        double from = 0.0;
        double to = 1.0;
        const auto [begin_low, begin_high] = heights_of(begins);
        const auto [end_low, end_high] = heights_of(ends);
        clip(begin_low, end_low - begin_low, from, to);
        clip(-begin_high, begin_high - end_high, from, to);
        for (int axis = 0; axis < 3 && from <= to; ++axis) {
            const double low = begins.min()[axis];
            const double high = begins.max()[axis];
            clip(low - box.max()[axis], ends.min()[axis] - low, from, to);
            clip(box.min()[axis] - high, high - ends.max()[axis], from, to);
        }
        return from <= to;
    }

    /// The lowest and the highest place of a box above the plane, to be on the safe side.
    std::pair<double, double> heights_of(const Box& b) const
    {
        const double middle = normal.dot(b.center()) - height;
        const double reach = normal.cwiseAbs().dot(b.sizes()) / 2 + tolerance;
        return {middle - reach, middle + reach};
    }

    bool meets(const Vector3d& begin, const Vector3d& end) const
    {
        return may_meet(Box(begin), Box(end)) && meets_triangle(begin, end, triangle);
    }
};

SightTree::SightTree(const Scene& scene, const std::vector<double>& margins)
{
    for (const View& view : scene.views) {
        ends_.push_back(view.center);
    }
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        const Vector3d& position = scene.positions[point];
        for (const std::uint32_t view : scene.tracks[point]) {
            const Vector3d line = ends_[view] - position;
            const double length = line.norm();
            if (length <= margins[point]) continue;
            sights_.push_back({position + line * (margins[point] / length), view});
        }
    }
    if (sights_.empty()) return;
    nodes_.resize(num_nodes(sights_.size()));
    build(0, 0, sights_.size());
}

void SightTree::build(std::size_t node, std::size_t first, std::size_t last)
{
    Shaft& shaft = nodes_[node];
    for (std::size_t i = first; i < last; ++i) {
        shaft.begins.extend(sights_[i].begin);
        shaft.ends.extend(ends_[sights_[i].view]);
    }
    if (last - first <= kLeafSights) return;

    // Split the longer side of the two boxes at the median.
    Eigen::Index begin_axis = 0;
    Eigen::Index end_axis = 0;
    const double begin_extent = kBeginWeight * shaft.begins.sizes().maxCoeff(&begin_axis);
    const bool by_begin = begin_extent >= shaft.ends.sizes().maxCoeff(&end_axis);
    const auto place = [&](const TrimmedSight& sight) {
        return by_begin ? sight.begin[begin_axis] : ends_[sight.view][end_axis];
    };
    const auto at = [&](std::size_t i) { return sights_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = middle_of(first, last);
    std::nth_element(
        at(first), at(middle), at(last),
        [&](const TrimmedSight& a, const TrimmedSight& b) { return place(a) < place(b); });
    const auto build_first = [&] { build(2 * node + 1, first, middle); };
    const auto build_rest = [&] { build(2 * node + 2, middle, last); };
    if (last - first > kParallelSights) {
        parallel_invoke(build_first, build_rest);
    } else {
        build_first();
        build_rest();
    }
}

void SightTree::visit_meeting(const std::array<Vector3d, 3>& triangle, const Visitor& visit) const
{
    if (nodes_.empty() || collinear(triangle[0], triangle[1], triangle[2])) return;
    const Shaft& all = nodes_[0];
    const auto reach = [](const Box& box) {
        return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    };
    const Query query(triangle, visit, std::max(reach(all.begins), reach(all.ends)));
    descend(0, 0, sights_.size(), query);
}

bool SightTree::descend(std::size_t node, std::size_t first, std::size_t last,
                        const Query& query) const
{
    if (!query.may_meet(nodes_[node].begins, nodes_[node].ends)) return true;
    if (last - first > kLeafSights) {
        const std::size_t middle = middle_of(first, last);
        return descend(2 * node + 1, first, middle, query) &&
               descend(2 * node + 2, middle, last, query);
    }
    for (std::size_t i = first; i < last; ++i) {
        const bool meets = query.meets(sights_[i].begin, ends_[sights_[i].view]);
        if (meets && !query.visit(i)) return false;
    }
    return true;
}

} // namespace vcarve
