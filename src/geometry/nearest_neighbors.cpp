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

struct NearestNeighbors::Search {
    Nearest::Tree tree;
};

NearestNeighbors::NearestNeighbors(const std::vector<Eigen::Vector3d>& points)
    : search_(std::make_unique<Search>())
{
    if (points.empty()) return; // CGAL cannot build an empty tree
    search_->tree.reserve(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        search_->tree.insert({to_cartesian(points[i]), i});
    }
    search_->tree.build<BuildTag>();
}

NearestNeighbors::~NearestNeighbors() = default;
NearestNeighbors::NearestNeighbors(NearestNeighbors&&) noexcept = default;

void NearestNeighbors::find(const Eigen::Vector3d& place, std::size_t count,
                            std::vector<Neighbor>& nearest) const
{
    nearest.clear();
    if (search_->tree.empty()) return;
    for (const auto& [numbered, distance_sq] :
         Nearest(search_->tree, to_cartesian(place), static_cast<unsigned>(count))) {
        nearest.push_back({numbered.second, distance_sq});
    }
}

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
    const NearestNeighbors tree(positions);
    progress.report(0.4);
    Neighborhoods neighborhoods(positions.size(), kept);
    parallel_for_ranges(positions.size(), progress.part(0.4, 1.0),
                        [&](std::size_t first, std::size_t last) {
                            std::vector<NearestNeighbors::Neighbor> nearest;
                            std::vector<std::uint32_t> around;
                            for (std::size_t i = first; i < last; ++i) {
                                tree.find(positions[i], kept + 1, nearest);
                                around.clear();
                                for (const auto& neighbor : nearest) {
                                    if (neighbor.point != i) around.push_back(neighbor.point);
                                }
                                neighborhoods.set(i, around, nearest.back().distance_sq);
                            }
                        });
    return neighborhoods;
}

} // namespace vcarve
