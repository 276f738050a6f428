#include "geometry/nearest_neighbors.h"

#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>
#include <CGAL/Search_traits_adapter.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/property_map.h>

#include <utility>

namespace vcarve {

namespace {

using Cartesian = CGAL::Simple_cartesian<double>;

Cartesian::Point_3 to_cartesian(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

using Numbered = std::pair<Cartesian::Point_3, std::uint32_t>;
using NeighborTraits =
    CGAL::Search_traits_adapter<Numbered, CGAL::First_of_pair_property_map<Numbered>,
                                CGAL::Search_traits_3<Cartesian>>;
using Nearest = CGAL::Orthogonal_k_neighbor_search<NeighborTraits>;

#ifdef VCARVE_WATCHES_THREADS
using BuildTag = CGAL::Sequential_tag; // it does not see how oneTBB's tasks hand work over
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
    if (points.empty()) return; // CGAL's tree is not to be built then
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

bool NearestNeighbors::has_nearer(const Eigen::Vector3d& place, double distance) const
{
    thread_local std::vector<Neighbor> nearest;
    find(place, 1, nearest);
    return !nearest.empty() && nearest.front().distance_sq < distance * distance;
}

} // namespace vcarve
