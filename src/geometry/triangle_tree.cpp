#include "geometry/triangle_tree.h"

#include "geometry/predicates.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <boost/iterator/function_output_iterator.hpp>

#include <algorithm>
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

/// A segment that is asked about.
class Question {
  public:
    Question(const Vector3d& from, const Vector3d& to)
        : segment_(to_point(from), to_point(to)),
          from_(from),
          per_way_((to - from).array().inverse()),
          magnitude_(from.lpNorm<1>() + to.lpNorm<1>())
    {
    }

    /// Exact.
    bool meets(const Kernel::Triangle_3& triangle) const
    {
        return CGAL::do_intersect(segment_, triangle);
    }
    /// Said of boxes a little off, too, so that rounding leaves out none that is met: the shares of
    /// the way between the planes of two sides have one in common for all three directions.
    bool may_meet(const CGAL::Bbox_3& box) const
    {
        constexpr double kRounding = 1e-12;
        const Array3d low(box.xmin(), box.ymin(), box.zmin());
        const Array3d high(box.xmax(), box.ymax(), box.zmax());
        const double off = kRounding * (magnitude_ + low.abs().sum() + high.abs().sum());
        const Array3d a = (low - off - from_) * per_way_;
        const Array3d b = (high + off - from_) * per_way_;
        const double enters = a.min(b).maxCoeff();
        const double leaves = a.max(b).minCoeff();
        return enters <= std::min(leaves, 1.0) && leaves >= 0.0;
    }

  private:
    using Array3d = Eigen::Array3d;

    Kernel::Segment_3 segment_;
    Array3d from_;
    Array3d per_way_; ///< infinite where the segment stays at one coordinate
    double magnitude_;
};

/// What CGAL asks a question about: triangles exactly, and boxes, of which there are many more,
/// not.
class Traits : public CGAL::AABB_traits<Kernel, Primitive> {
  public:
    struct Meets {
        bool operator()(const Question& question, const CGAL::Bbox_3& box) const
        {
            return question.may_meet(box);
        }
        bool operator()(const Question& question, const Primitive& triangle) const
        {
            return question.meets(triangle.datum());
        }
    };

    static Meets do_intersect_object() { return {}; }
};

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
    CGAL::AABB_tree<Traits> tree;
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
    return tree_ != nullptr && tree_->tree.do_intersect(Question(from, to));
}

void TriangleTree::visit_met(const Vector3d& from, const Vector3d& to, const Visitor& visit) const
{
    if (tree_ == nullptr) return;
    const auto begin = tree_->triangles.cbegin();
    tree_->tree.all_intersected_primitives(
        Question(from, to), boost::make_function_output_iterator([&](const Primitive::Id& met) {
            visit(tree_->places[static_cast<std::size_t>(met - begin)]);
        }));
}

} // namespace vcarve
