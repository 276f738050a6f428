#include "mesh/self_intersections.h"

#include "base/parallel_count.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/box_intersection_d.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Corners = std::array<Kernel::Point_3, 3>;
using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

Kernel::Triangle_3 triangle(const Corners& corners)
{
    return {corners[0], corners[1], corners[2]};
}

/// Puts the corners of a triangle that are none of another one's first; how many there are.
std::ptrdiff_t own_first(Corners& corners, const Corners& others)
{
    const auto is_own = [&](const Kernel::Point_3& corner) {
        return std::ranges::find(others, corner) == others.end();
    };
    return std::partition(corners.begin(), corners.end(), is_own) - corners.begin();
}

bool intersect(Corners a, Corners b)
{
    const std::ptrdiff_t own = own_first(a, b);
    own_first(b, a);
    switch (own) {
    case 0:
        return true;
    case 1: // folded back at their edge
        return CGAL::coplanar(a[0], a[1], a[2], b[0]) &&
               CGAL::coplanar_orientation(a[1], a[2], a[0], b[0]) == CGAL::POSITIVE;
    case 2:
        return CGAL::do_intersect(triangle(a), Kernel::Segment_3(b[0], b[1])) ||
               CGAL::do_intersect(triangle(b), Kernel::Segment_3(a[0], a[1]));
    default:
        return CGAL::do_intersect(triangle(a), triangle(b));
    }
}

} // namespace

std::int64_t count_self_intersections(const TriMesh& mesh)
{
    const auto corners_of = [&](std::uint32_t face) {
        Corners corners;
        std::ranges::transform(mesh.faces[face], corners.begin(), [&](std::uint32_t v) {
            const Eigen::Vector3d& at = mesh.positions[v];
            return Kernel::Point_3(at.x(), at.y(), at.z());
        });
        return corners;
    };
    std::vector<Box> boxes;
    boxes.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Corners corners = corners_of(f);
        if (CGAL::collinear(corners[0], corners[1], corners[2])) continue;
        boxes.emplace_back(CGAL::bbox_3(corners.begin(), corners.end()), f);
    }
    std::vector<const Box*> all; // pointers are moved faster
    for (const Box& box : boxes) {
        all.push_back(&box);
    }
    constexpr std::ptrdiff_t kFewBoxes = 1000; // takes half the time of CGAL's default, 10
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
    const auto keep = [&](const Box* a, const Box* b) { near.emplace_back(a->info(), b->info()); };
    CGAL::box_self_intersection_d(all.begin(), all.end(), keep, kFewBoxes);
    return static_cast<std::int64_t>(parallel_count(near.size(), [&](std::size_t i) {
        return intersect(corners_of(near[i].first), corners_of(near[i].second));
    }));
}

} // namespace vcarve
