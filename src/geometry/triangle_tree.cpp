#include "geometry/triangle_tree.h"

#include "geometry/predicates.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

Kernel::Point_3 to_point(const Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

} // namespace

struct TriangleTree::Tree {
    explicit Tree(Triangles all)
        : triangles(std::move(all)), tree(triangles.begin(), triangles.end())
    {
        tree.build();
    }

    Triangles triangles;
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
};

TriangleTree::TriangleTree(std::span<const std::array<Vector3d, 3>> triangles)
{
    Triangles with_area;
    for (const auto& [a, b, c] : triangles) {
        if (!collinear(a, b, c)) with_area.emplace_back(to_point(a), to_point(b), to_point(c));
    }
    if (!with_area.empty()) tree_ = std::make_unique<Tree>(std::move(with_area));
}

TriangleTree::~TriangleTree() = default;

bool TriangleTree::is_met(const Vector3d& from, const Vector3d& to) const
{
    return tree_ != nullptr &&
           tree_->tree.do_intersect(Kernel::Segment_3(to_point(from), to_point(to)));
}

} // namespace vcarve
