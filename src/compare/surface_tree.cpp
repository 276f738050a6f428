#include "compare/surface_tree.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <cmath>
#include <vector>

namespace vcarve {
namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Point = Kernel::Point_3;
using Triangle = Kernel::Triangle_3;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, std::vector<Triangle>::const_iterator>;
using AabbTree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

Point to_point(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
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

double SurfaceTree::distance(const Eigen::Vector3d& point) const
{
    return std::sqrt(tree_->aabb.squared_distance(to_point(point)));
}

bool SurfaceTree::blocks(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const
{
    return tree_->aabb.do_intersect(Kernel::Segment_3(to_point(from), to_point(to)));
}

} // namespace vcarve
