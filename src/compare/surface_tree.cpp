#include "compare/surface_tree.h"

#include "geometry/predicates.h"
#include "geometry/triangle.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using AabbTraits = CGAL::AABB_traits<Kernel, Primitive>;
using AabbTree = CGAL::AABB_tree<AabbTraits>;
using Eigen::Vector3d;

Point to_point(const Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

Vector3d to_vector(const Point& point)
{
    return {point.x(), point.y(), point.z()};
}

std::vector<Triangle> triangles_with_area(const TriMesh& mesh)
{
    std::vector<Triangle> triangles;
    triangles.reserve(mesh.faces.size());
    for (const Face& face : mesh.faces) {
        const Triangle triangle(to_point(mesh.positions[face[0]]),
                                to_point(mesh.positions[face[1]]),
                                to_point(mesh.positions[face[2]]));
        const double area_sq = triangle.squared_area();
        if (std::isfinite(area_sq) && area_sq > 0.0) triangles.push_back(triangle);
    }
    return triangles;
}

/// A ray made ready to be held against many boxes and triangles.
class Ray {
  public:
    Ray(const Vector3d& from, const Vector3d& towards)
        : from_(from), towards_(towards), line_(towards - from), inverse_(line_.cwiseInverse())
    {
    }

    /// How far along the box begins, infinite where the ray passes it. Never says so of a box it
    /// meets: the end is moved away by more than all that was rounded (Ize, "Robust BVH Ray
    /// Traversal", 2013).
    double entry(const CGAL::Bbox_3& box) const
    {
        double begin = 0.0;
        double end = kMissed;
        for (int axis = 0; axis < 3; ++axis) {
            double near = (box.min(axis) - from_[axis]) * inverse_[axis];
            double far = (box.max(axis) - from_[axis]) * inverse_[axis];
            if (inverse_[axis] < 0.0) std::swap(near, far);
            // Neither holds for the NaN of a ray that runs in the box's side.
            if (near > begin) begin = near;
            if (far < end) end = far;
        }
        return begin <= end * kBeyondRounding ? begin : kMissed;
    }

    std::optional<FirstHit> meets(const Triangle& triangle) const
    {
        const std::array<Vector3d, 3> corners = {to_vector(triangle[0]), to_vector(triangle[1]),
                                                 to_vector(triangle[2])};
        // On which side of each edge the ray passes.
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

    /// Of the mean of the corners by weight: so it never leaves the triangle, however slim.
    double place_along(const std::array<Vector3d, 3>& corners, const Vector3d& weights) const
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
    Vector3d inverse_;
};

/// Keeps the nearest of all triangles a ray meets; tells the tree to look at near boxes first, and
/// at none behind what is found.
class FirstHitTraits {
  public:
    using Node = CGAL::AABB_node<AabbTraits>;
    using Priority = double;

    bool do_intersect(const Ray& ray, const Node& node) const
    {
        return do_intersect_with_priority(ray, node).first;
    }

    std::pair<bool, Priority> do_intersect_with_priority(const Ray& ray, const Node& node) const
    {
        const double entry = ray.entry(node.bbox());
        const double limit = hit_ ? hit_->along * Ray::kBeyondRounding : Ray::kMissed;
        return {entry < Ray::kMissed && entry <= limit, -entry};
    }

    void intersection(const Ray& ray, const Primitive& primitive)
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

struct SurfaceTree::Tree {
    std::vector<Triangle> triangles;
    AabbTree aabb;

    explicit Tree(std::vector<Triangle> list)
        : triangles(std::move(list)), aabb(triangles.begin(), triangles.end())
    {
        aabb.build();
        aabb.accelerate_distance_queries();
    }
};

SurfaceTree::SurfaceTree(const TriMesh& mesh)
    : tree_(std::make_unique<const Tree>(triangles_with_area(mesh)))
{
}

SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

double SurfaceTree::distance(const Vector3d& point) const
{
    return std::sqrt(tree_->aabb.squared_distance(to_point(point)));
}

NearestFace SurfaceTree::nearest(const Vector3d& point) const
{
    const auto [place, face] = tree_->aabb.closest_point_and_primitive(to_point(point));
    const Vector3d normal =
        scaled_normal(to_vector((*face)[0]), to_vector((*face)[1]), to_vector((*face)[2]));
    return {.distance = std::sqrt(CGAL::squared_distance(to_point(point), place)),
            .normal = normal.normalized()};
}

bool SurfaceTree::blocks(const Vector3d& from, const Vector3d& to) const
{
    return tree_->aabb.do_intersect(Kernel::Segment_3(to_point(from), to_point(to)));
}

std::optional<FirstHit> SurfaceTree::first_hit(const Vector3d& from, const Vector3d& towards) const
{
    FirstHitTraits traits;
    tree_->aabb.traversal_with_priority(Ray(from, towards), traits);
    return traits.hit();
}

} // namespace vcarve
