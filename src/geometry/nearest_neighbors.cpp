#include "geometry/nearest_neighbors.h"

#include "base/parallel.h"
#include "geometry/cgal_kernel.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

using Numbered = std::pair<Cartesian::Point_3, std::uint32_t>;
using NeighborTraits =
    CGAL::Search_traits_adapter<Numbered, CGAL::First_of_pair_property_map<Numbered>,
                                CGAL::Search_traits_3<Cartesian>>;
using Nearest = CGAL::Orthogonal_k_neighbor_search<NeighborTraits>;

#ifdef VCARVE_WATCHES_THREADS
using BuildTag = CGAL::Sequential_tag; // ThreadSanitizer cannot follow oneTBB's tasks
#else
using BuildTag = CGAL::Parallel_if_available_tag;
#endif

} // namespace

void Neighborhoods::set(std::size_t point, std::span<const std::uint32_t> around, double reach_sq)
{
    std::ranges::copy(around, points_.begin() + static_cast<std::ptrdiff_t>(most_ * point));
    counts_[point] = static_cast<std::uint32_t>(around.size());
    reaches_sq_[point] = reach_sq;
}

Neighborhoods nearest_neighborhoods(const std::vector<Eigen::Vector3d>& positions,
                                    std::size_t count, const Progress& progress)
{
    const std::size_t kept = std::min(count, positions.size() - 1);
    Nearest::Tree tree;
    tree.reserve(positions.size());
    for (std::uint32_t i = 0; i < positions.size(); ++i)
        tree.insert({to_cartesian(positions[i]), i});
    tree.build<BuildTag>();
    progress.report(0.4);
    Neighborhoods neighborhoods(positions.size(), kept);
    const auto find = [&](std::size_t i) {
        thread_local std::vector<std::uint32_t> around;
        around.clear();
        const Nearest nearest(tree, to_cartesian(positions[i]), static_cast<unsigned>(kept + 1));
        double reach_sq = 0.0;
        for (const auto& [neighbor, distance_sq] : nearest) {
            reach_sq = distance_sq;
            if (neighbor.second != i && around.size() < kept) around.push_back(neighbor.second);
        }
        neighborhoods.set(i, around, reach_sq);
    };
    parallel_for(positions.size(), progress.part(0.4, 1.0), find);
    return neighborhoods;
}

} // namespace vcarve
