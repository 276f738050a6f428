#include "geometry/triangle_tree.h"

#include "geometry/predicates.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <boost/iterator/function_output_iterator.hpp>

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
    Tree(Triangles with_area, std::vector<std::size_t> their_places)
        : triangles(std::move(with_area)),
          places(std::move(their_places)),
          tree(triangles.begin(), triangles.end())
    {
        tree.build();
    }

    Triangles triangles;
    std::vector<std::size_t> places; ///< of each among all
    CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
};

TriangleTree::TriangleTree(std::span<const std::array<Vector3d, 3>> triangles)
{
    Triangles with_area;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const auto& [a, b, c] = triangles[i];
        if (collinear(a, b, c)) continue;
        with_area.emplace_back(to_point(a), to_point(b), to_point(c));
        places.push_back(i);
    }
    if (!places.empty()) tree_ = std::make_unique<Tree>(std::move(with_area), std::move(places));
}

TriangleTree::~TriangleTree() = default;

bool TriangleTree::is_met(const Vector3d& from, const Vector3d& to) const
{
    return tree_ != nullptr &&
           tree_->tree.do_intersect(Kernel::Segment_3(to_point(from), to_point(to)));
}

void TriangleTree::visit_met(const Vector3d& from, const Vector3d& to, const Visitor& visit) const
{
    if (tree_ == nullptr) return;
    const auto begin = tree_->triangles.cbegin();
    tree_->tree.all_intersected_primitives(
        Kernel::Segment_3(to_point(from), to_point(to)),
        boost::make_function_output_iterator([&](const Primitive::Id& met) {
            visit(tree_->places[static_cast<std::size_t>(met - begin)]);
        }));
}

} // namespace vcarve
