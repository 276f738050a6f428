#include "points/arrange.h"

#include "base/parallel.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>
#include <tbb/parallel_sort.h>

#include <numeric>
#include <tuple>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointMap = CGAL::Pointer_property_map<Kernel::Point_3>::type;
using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Kernel, PointMap>;

/// Point indices along a Hilbert curve. Sorted by coordinates first, so that the sort, which is
/// deterministic but not stable, starts from the same sequence whatever the order of the input.
std::vector<std::size_t> hilbert_order(const std::vector<Vector3d>& positions)
{
    std::vector<std::size_t> order(positions.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    tbb::parallel_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        const Vector3d& p = positions[a];
        const Vector3d& q = positions[b];
        return std::tie(p.x(), p.y(), p.z()) < std::tie(q.x(), q.y(), q.z());
    });
    std::vector<Kernel::Point_3> points;
    points.reserve(positions.size());
    for (const Vector3d& p : positions) {
        points.emplace_back(p.x(), p.y(), p.z());
    }
    CGAL::hilbert_sort<CGAL::Parallel_if_available_tag>(
        order.begin(), order.end(), SortTraits(CGAL::make_property_map(points)));
    return order;
}

template <typename T>
std::vector<T> reordered(const std::vector<T>& values, const std::vector<std::size_t>& order)
{
    std::vector<T> result(order.size());
    parallel_for(order.size(), [&](std::size_t i) { result[i] = values[order[i]]; });
    return result;
}

Tracks reordered(const Tracks& tracks, const std::vector<std::size_t>& order)
{
    Tracks result;
    result.begins.reserve(order.size() + 1);
    result.views.reserve(tracks.views.size());
    for (const std::size_t point : order) {
        result.push_back(tracks[point]);
    }
    return result;
}

} // namespace

Scene arrange_points(Scene scene)
{
    const std::vector<std::size_t> order = hilbert_order(scene.positions);
    scene.positions = reordered(scene.positions, order);
    scene.colors = reordered(scene.colors, order);
    scene.errors_px = reordered(scene.errors_px, order);
    scene.point_ids = reordered(scene.point_ids, order);
    scene.tracks = reordered(scene.tracks, order);
    return scene;
}

} // namespace vcarve
