#include "geometry/triangle_tree.h"

#include "geometry/cgal_kernel.h"
#include "geometry/predicates.h"
#include "geometry/triangle.h"

#include <CGAL/AABB_tree.h>
#if __has_include(<CGAL/AABB_traits_3.h>) // CGAL 6
#include <CGAL/AABB_traits_3.h>
#include <CGAL/AABB_triangle_primitive_3.h>
#else
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_triangle_primitive.h>
#endif
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using Corners = std::array<Vector3d, 3>;
using Point = Cartesian::Point_3;
using Triangle = Cartesian::Triangle_3;
using Triangles = std::vector<Triangle>;
#if __has_include(<CGAL/AABB_traits_3.h>)
using Primitive = CGAL::AABB_triangle_primitive_3<Cartesian, Triangles::const_iterator>;
using BoxTraits = CGAL::AABB_traits_3<Cartesian, Primitive>;
#else
using Primitive = CGAL::AABB_triangle_primitive<Cartesian, Triangles::const_iterator>;
using BoxTraits = CGAL::AABB_traits<Cartesian, Primitive>;
#endif

Vector3d to_vector(const Point& point)
{
    return {point.x(), point.y(), point.z()};
}

Corners corners_of(const Triangle& triangle)
{
    return {to_vector(triangle[0]), to_vector(triangle[1]), to_vector(triangle[2])};
}

bool has_area(const Corners& corners)
{
    const auto& [a, b, c] = corners;
    const double size_sq = scaled_normal(a, b, c).squaredNorm();
    return std::isfinite(size_sq) && size_sq > 0.0 && !collinear(a, b, c);
}

/// A ray or segment, prepared for tests against many boxes and triangles.
class RayQuery {
  public:
    RayQuery(const Vector3d& from, const Vector3d& towards)
        : from_(from), towards_(towards), line_(towards - from), inverse_(line_.cwiseInverse())
    {
    }

    /// The ray parameter at which the ray enters a box; kMissed if it misses the box. Never misses
    /// a box that it meets: the exit is moved back by more than the rounding error (Ize, "Robust
    /// BVH Ray Traversal", 2013).
    double entry(const CGAL::Bbox_3& box) const
    {
        double begin = 0.0;
        double end = kMissed;
        for (int axis = 0; axis < 3; ++axis) {
            double near = (box.min(axis) - from_[axis]) * inverse_[axis];
            double far = (box.max(axis) - from_[axis]) * inverse_[axis];
            if (inverse_[axis] < 0.0) std::swap(near, far);
            // Both are false for NaN, if the ray is in the plane of a side.
            if (near > begin) begin = near;
            if (far < end) end = far;
        }
        return begin <= end * kBeyondRounding ? begin : kMissed;
    }

    /// Whether the segment from `from` to `towards` meets the triangle.
    bool segment_meets(const Triangle& triangle) const
    {
        return meets_triangle(from_, towards_, corners_of(triangle));
    }

    /// The hit of the ray with the triangle, which may be at or beyond `towards`.
    std::optional<FirstHit> meets(const Triangle& triangle) const
    {
        const Corners corners = corners_of(triangle);
        // The side on which the ray passes each edge.
        int least = 0;
        int most = 0;
        Vector3d weights;
        for (std::size_t i = 0; i < 3; ++i) {
            const Vector3d& a = corners[(i + 1) % 3];
            const Vector3d& b = corners[(i + 2) % 3];
            const int side = orientation(from_, towards_, a, b);
            least = std::min(least, side);
            most = std::max(most, side);
            if (least < 0 && most > 0) return std::nullopt;
            weights[static_cast<Eigen::Index>(i)] = volume(a, b) * side;
        }
        if (least == most) return std::nullopt;
        const double along = place_along(corners, weights.cwiseMax(0.0));
        if (along < 0.0) return std::nullopt;
        return FirstHit{.along = along, .front = least < 0};
    }

    static constexpr double kMissed = std::numeric_limits<double>::infinity();
    static constexpr double kBeyondRounding = 1.0 + 16.0 * std::numeric_limits<double>::epsilon();

  private:
    double volume(const Vector3d& a, const Vector3d& b) const
    {
        return line_.dot((a - from_).cross(b - from_));
    }

    /// The ray parameter of the weighted mean of the corners, which is inside even thin triangles.
    double place_along(const Corners& corners, const Vector3d& weights) const
    {
        const double sum = weights.sum();
        const Vector3d shares = sum > 0.0 ? Vector3d(weights / sum) : Vector3d::Constant(1.0 / 3.0);
        const Vector3d place = shares[0] * (corners[0] - from_) + shares[1] * (corners[1] - from_) +
                               shares[2] * (corners[2] - from_);
        return place.dot(line_) / line_.squaredNorm();
    }

    Vector3d from_;
    Vector3d towards_;
    Vector3d line_;
    Vector3d inverse_; ///< infinite if a coordinate is constant along the ray
};

/// Intersection tests of segments for CGAL's tree. Tests of triangles are exact. Tests of boxes,
/// which are far more frequent, are conservative.
class Traits : public BoxTraits {
  public:
    struct Meets {
        bool operator()(const RayQuery& segment, const CGAL::Bbox_3& box) const
        {
            return segment.entry(box) <= RayQuery::kBeyondRounding;
        }
        bool operator()(const RayQuery& segment, const Primitive& triangle) const
        {
            return segment.segment_meets(*triangle.id());
        }
    };

    static Meets do_intersect_object() { return {}; }
};
using AabbTree = CGAL::AABB_tree<Traits>;

/// Finds the first hit of a ray. The tree visits near boxes first, and skips boxes behind the
/// nearest hit so far.
class FirstHitTraits {
  public:
    using Node = CGAL::AABB_node<Traits>;
    using Priority = double;

    bool do_intersect(const RayQuery& ray, const Node& node) const
    {
        return do_intersect_with_priority(ray, node).first;
    }

    std::pair<bool, Priority> do_intersect_with_priority(const RayQuery& ray,
                                                         const Node& node) const
    {
        const double entry = ray.entry(node.bbox());
        const double limit = hit_ ? hit_->along * RayQuery::kBeyondRounding : RayQuery::kMissed;
        return {entry < RayQuery::kMissed && entry <= limit, -entry};
    }

    void intersection(const RayQuery& ray, const Primitive& primitive)
    {
        const std::optional<FirstHit> hit = ray.meets(*primitive.id());
        if (!hit) return;
        const bool before = !hit_ || hit->along < hit_->along ||
                            (hit->along == hit_->along && hit->front && !hit_->front);
        if (before) hit_ = hit;
    }

    static bool go_further() { return true; }
    const std::optional<FirstHit>& hit() const { return hit_; }

  private:
    std::optional<FirstHit> hit_;
};

} // namespace

struct TriangleTree::Tree {
    Triangles triangles;             ///< without degenerate ones
    std::vector<std::size_t> places; ///< index of each triangle in the input
    AabbTree aabb;

    template <typename CornersOf>
    Tree(std::size_t count, const CornersOf& corners_of)
    {
        for (std::size_t i = 0; i < count; ++i) {
            const Corners corners = corners_of(i);
            if (!has_area(corners)) continue;
            const auto& [a, b, c] = corners;
            triangles.emplace_back(to_cartesian(a), to_cartesian(b), to_cartesian(c));
            places.push_back(i);
        }
        aabb.rebuild(triangles.cbegin(), triangles.cend());
    }
};

TriangleTree::TriangleTree(std::span<const Corners> triangles)
    : tree_(std::make_unique<const Tree>(triangles.size(),
                                         [&](std::size_t i) { return triangles[i]; }))
{
}

TriangleTree::TriangleTree(const TriMesh& mesh)
    : tree_(std::make_unique<const Tree>(mesh.faces.size(), [&](std::size_t i) {
          return vcarve::corners_of(mesh.positions, mesh.faces[i]);
      }))
{
}

TriangleTree::~TriangleTree() = default;
TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;

bool TriangleTree::is_empty() const
{
    return tree_->triangles.empty();
}

bool TriangleTree::is_met(const Vector3d& from, const Vector3d& to) const
{
    return tree_->aabb.do_intersect(RayQuery(from, to));
}

void TriangleTree::visit_met(const Vector3d& from, const Vector3d& to, const Visitor& visit) const
{
    const auto begin = tree_->triangles.cbegin();
    tree_->aabb.all_intersected_primitives(
        RayQuery(from, to), boost::make_function_output_iterator([&](const Primitive::Id& met) {
            visit(tree_->places[static_cast<std::size_t>(met - begin)]);
        }));
}

std::optional<FirstHit> TriangleTree::first_hit(const Vector3d& from, const Vector3d& towards) const
{
    FirstHitTraits traits;
    tree_->aabb.traversal_with_priority(RayQuery(from, towards), traits);
    return traits.hit();
}

double TriangleTree::distance(const Vector3d& point) const
{
    return std::sqrt(tree_->aabb.squared_distance(to_cartesian(point)));
}

NearestFace TriangleTree::nearest(const Vector3d& point) const
{
    const auto [place, face] = tree_->aabb.closest_point_and_primitive(to_cartesian(point));
    const auto [a, b, c] = corners_of(*face);
    return {.distance = std::sqrt(CGAL::squared_distance(to_cartesian(point), place)),
            .normal = scaled_normal(a, b, c).normalized()};
}

} // namespace vcarve
