#include "steps/7_refine/ray_guard.h"

#include "base/parallel.h"
#include "geometry/predicates.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

using Triangle = std::array<Vector3d, 3>;

constexpr std::size_t kLeafRays = 8;
constexpr std::size_t kParallelRays = 1U << 14U;
/// Weight of extents at the start of rays, close to the surface and so to triangles.
constexpr double kBeginWeight = 2.0;

std::size_t middle_of(std::size_t first, std::size_t last)
{
    return first + (last - first) / 2;
}

std::size_t num_nodes(std::size_t rays)
{
    std::size_t nodes = 1;
    for (; rays > kLeafRays; rays -= rays / 2) {
        nodes = 2 * nodes + 1;
    }
    return nodes;
}

/// Intersects the interval `from` .. `to` with the t in [0, 1] at which the linear function from
/// `begin` to `end` is at most 0.
inline void clip(double begin, double end, double& from, double& to)
{
    if (begin <= 0.0) {
        if (end > 0.0) to = std::min(to, begin / (begin - end));
    } else {
        from = end <= 0.0 ? std::max(from, begin / (begin - end)) : 2.0;
    }
}

bool is_flat(const Triangle& t)
{
    return collinear(t[0], t[1], t[2]);
}

bool meets(const Triangle& triangle, const Vector3d& begin, const Vector3d& end)
{
    return !is_flat(triangle) && meets_triangle(begin, end, triangle);
}

/// Per point, the ignored length of its rays; the smaller one if two vertices share a point.
std::vector<double> margins_of_points(const Scene& scene, const HalfEdgeMesh& surface)
{
    const std::vector<double> spacings = vertex_spacings(surface);
    std::vector<double> margins(scene.num_points(), 0.0);
    for (std::size_t v = 0; v < spacings.size(); ++v) {
        const auto vertex = handle_at<OpenMesh::VertexHandle>(v);
        const std::uint32_t point = surface.data(vertex).scene_point;
        if (point == kNoPoint || surface.is_deleted(vertex)) continue;
        double& margin = margins[point];
        margin = margin > 0.0 ? std::min(margin, spacings[v]) : spacings[v];
    }
    return margins;
}

} // namespace

/// Triangles, and bounds that exclude most rays quickly. Tolerances only enlarge the bounds.
struct RayTree::Query {
    std::vector<Triangle> triangles; ///< without degenerate ones
    const Visitor& visit;
    Box box;
    Vector3d normal = Vector3d::Zero();
    double low = HUGE_VAL; ///< lowest height along `normal`
    double high = -HUGE_VAL;

    Query(std::span<const Triangle> all, const Visitor& visitor, double extent) : visit(visitor)
    {
        constexpr double kRounding = 1e-12;
        std::ranges::remove_copy_if(all, std::back_inserter(triangles), is_flat);
        double longest_sq = 0.0;
        for (const auto& [a, b, c] : triangles) {
            box.extend(a).extend(b).extend(c);
            normal += scaled_normal(a, b, c);
            longest_sq = std::max({longest_sq, (b - a).squaredNorm(), (c - a).squaredNorm()});
        }
        const double reach = kRounding * std::max(extent, box.min().cwiseAbs().maxCoeff() +
                                                              box.max().cwiseAbs().maxCoeff());
        box.min().array() -= reach;
        box.max().array() += reach;
        for (const Triangle& triangle : triangles) {
            for (const Vector3d& corner : triangle) {
                low = std::min(low, normal.dot(corner));
                high = std::max(high, normal.dot(corner));
            }
        }
        // The rounding error of the cross products, times their lever.
        const double count = static_cast<double>(triangles.size());
        const double tolerance = 4.0 * (normal.lpNorm<1>() + count * longest_sq) * reach;
        low -= tolerance;
        high += tolerance;
    }

    /// Whether a segment between the boxes may touch both the slab and the box of the triangles.
    bool may_meet(const Box& begins, const Box& ends) const
    {
        double from = 0.0;
        double to = 1.0;
        for (int axis = 0; axis < 3 && from <= to; ++axis) {
            clip(begins.min()[axis] - box.max()[axis], ends.min()[axis] - box.max()[axis], from,
                 to);
            clip(box.min()[axis] - begins.max()[axis], box.min()[axis] - ends.max()[axis], from,
                 to);
        }
        if (from > to) return false;
        const auto [begin_low, begin_high] = heights_of(begins);
        const auto [end_low, end_high] = heights_of(ends);
        clip(begin_low - high, end_low - high, from, to);
        clip(low - begin_high, low - end_high, from, to);
        return from <= to;
    }

    /// The lowest and the highest coordinate of a box along `normal`.
    std::pair<double, double> heights_of(const Box& b) const
    {
        const double middle = normal.dot(b.center());
        const double reach = normal.cwiseAbs().dot(b.sizes()) / 2;
        return {middle - reach, middle + reach};
    }

    bool meets(const Vector3d& begin, const Vector3d& end) const
    {
        return may_meet(Box(begin), Box(end)) &&
               std::ranges::any_of(triangles, [&](const Triangle& triangle) {
                   return meets_triangle(begin, end, triangle);
               });
    }
};

RayTree::RayTree(const Scene& scene, const std::vector<double>& margins)
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
            rays_.push_back({position + line * (margins[point] / length), view});
        }
    }
    if (rays_.empty()) return;
    nodes_.resize(num_nodes(rays_.size()));
    build(0, 0, rays_.size());
}

void RayTree::build(std::size_t node, std::size_t first, std::size_t last)
{
    Shaft& shaft = nodes_[node];
    for (std::size_t i = first; i < last; ++i) {
        shaft.begins.extend(rays_[i].begin);
        shaft.ends.extend(ends_[rays_[i].view]);
    }
    if (last - first <= kLeafRays) return;

    // Split the longest side of the two boxes at the median.
    Eigen::Index begin_axis = 0;
    Eigen::Index end_axis = 0;
    const double begin_extent = kBeginWeight * shaft.begins.sizes().maxCoeff(&begin_axis);
    const bool by_begin = begin_extent >= shaft.ends.sizes().maxCoeff(&end_axis);
    const auto place = [&](const TrimmedRay& ray) {
        return by_begin ? ray.begin[begin_axis] : ends_[ray.view][end_axis];
    };
    const auto at = [&](std::size_t i) { return rays_.begin() + static_cast<std::ptrdiff_t>(i); };
    const std::size_t middle = middle_of(first, last);
    std::nth_element(at(first), at(middle), at(last),
                     [&](const TrimmedRay& a, const TrimmedRay& b) { return place(a) < place(b); });
    const auto build_first = [&] { build(2 * node + 1, first, middle); };
    const auto build_rest = [&] { build(2 * node + 2, middle, last); };
    if (last - first > kParallelRays) {
        parallel_invoke(build_first, build_rest);
    } else {
        build_first();
        build_rest();
    }
}

void RayTree::visit_meeting(std::span<const Triangle> triangles, const Visitor& visit) const
{
    if (nodes_.empty()) return;
    const Shaft& all = nodes_[0];
    const auto reach = [](const Box& box) {
        return std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    };
    const Query query(triangles, visit, std::max(reach(all.begins), reach(all.ends)));
    if (!query.triangles.empty()) descend(0, 0, rays_.size(), query);
}

bool RayTree::descend(std::size_t node, std::size_t first, std::size_t last,
                      const Query& query) const
{
    if (!query.may_meet(nodes_[node].begins, nodes_[node].ends)) return true;
    if (last - first > kLeafRays) {
        const std::size_t middle = middle_of(first, last);
        return descend(2 * node + 1, first, middle, query) &&
               descend(2 * node + 2, middle, last, query);
    }
    for (std::size_t i = first; i < last; ++i) {
        const bool meets = query.meets(rays_[i].begin, ends_[rays_[i].view]);
        if (meets && !query.visit(i)) return false;
    }
    return true;
}

RayGuard::RayGuard(const Scene& scene, const HalfEdgeMesh& surface, const Progress& progress)
    : rays_(scene, margins_of_points(scene, surface))
{
    progress.report(0.5);
    const TriMesh mesh = tri_mesh(surface);
    progress.report(0.6);
    faces_.emplace(mesh);
}

bool RayGuard::blocks(std::span<const Triangle> before, std::span<const Triangle> after) const
{
    bool found = false;
    rays_.visit_meeting(after, [&](std::size_t ray) {
        const auto is_met = [&](const Triangle& triangle) {
            return meets(triangle, rays_[ray].begin, rays_.end_of(ray));
        };
        found = std::ranges::none_of(before, is_met) &&
                !faces_->is_met(rays_[ray].begin, rays_.end_of(ray));
        return !found;
    });
    return found;
}

} // namespace vcarve
