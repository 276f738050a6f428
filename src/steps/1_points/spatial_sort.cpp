#include "steps/1_points/spatial_sort.h"

#include "model/scene_points.h"
#include "steps/1_points/lexicographic_sort.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <cstdint>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointMap = CGAL::Pointer_property_map<Kernel::Point_3>::type;
using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, PointMap>;

/// Point indices along a Hilbert curve. Sorted by place first, so that the sort, which is
/// deterministic but not stable, starts from the same sequence whatever the order of the input.
std::vector<std::size_t> hilbert_order(const std::vector<Vector3d>& positions)
{
    const std::vector<std::uint32_t> by_place = lexicographic_sort(positions);
    std::vector<std::size_t> order(by_place.begin(), by_place.end());
    std::vector<Kernel::Point_3> points;
    points.reserve(positions.size());
    for (const Vector3d& p : positions) {
        points.emplace_back(p.x(), p.y(), p.z());
    }
    CGAL::hilbert_sort<CGAL::Parallel_if_available_tag>(
        order.begin(), order.end(), SortTraits(CGAL::make_property_map(points)));
    return order;
}

} // namespace

Scene spatial_sort(const Scene& scene, const Progress& progress)
{
    const std::vector<std::size_t> order = hilbert_order(scene.positions);
    progress.tell(0.8);
    return select_points(scene, order, [&](std::size_t i) { return scene.tracks[order[i]]; });
}

} // namespace vcarve
