#include "mesh/local_edges.h"

#include "base/median.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <utility>

namespace vcarve {

using Eigen::Vector3d;

LocalEdges::LocalEdges(std::span<const Vector3d> positions, const std::vector<Face>& faces,
                       const FaceFlags& measured)
    : positions_(positions),
      faces_(faces),
      faces_at_(faces, positions.size(), measured),
      medians_(positions.size(), -1.0)
{
}

void LocalEdges::replace_faces_at(std::uint32_t vertex, std::vector<std::uint32_t> faces)
{
    faces_at_.replace(vertex, std::move(faces));
    medians_[vertex] = -1.0;
}

void LocalEdges::collect_squared_lengths(std::uint32_t vertex,
                                         std::vector<double>& lengths_sq) const
{
    for (const std::uint32_t face : faces_at_[vertex]) {
        const auto& [a, b, c] = faces_[face];
        lengths_sq.insert(lengths_sq.end(),
                          {squared_length(a, b), squared_length(b, c), squared_length(c, a)});
    }
}

double LocalEdges::median(std::uint32_t vertex) const
{
    const std::atomic_ref<double> known(medians_[vertex]);
    const double found = known.load(std::memory_order_relaxed);
    if (found >= 0.0) return found;
    std::vector<double> lengths_sq;
    collect_squared_lengths(vertex, lengths_sq);
    const double median = std::sqrt(median_in_place(lengths_sq)); // roots keep the order
    known.store(median, std::memory_order_relaxed); // whoever else finds it finds the same
    return median;
}

double LocalEdges::longest_edge(std::size_t face) const
{
    const auto& [a, b, c] = faces_[face];
    return std::sqrt(std::max({squared_length(a, b), squared_length(b, c), squared_length(c, a)}));
}

double LocalEdges::relative_size(std::size_t face) const
{
    const auto& [a, b, c] = faces_[face];
    std::array<double, 3> scales = {median(a), median(b), median(c)};
    std::sort(scales.begin(), scales.end());
    return longest_edge(face) / scales[1];
}

/// Which vertices may have an edge around them of `size` medians or more: those where more than
/// half of the lengths are at most the longest over `size`.
std::vector<std::uint8_t> LocalEdges::uneven_vertices(double size) const
{
    constexpr double kRounding = 1.0 + 1e-9;
    std::vector<std::uint8_t> uneven(positions_.size(), 0);
    parallel_for_with_list<double>(uneven.size(), [&](std::size_t v, auto& values) {
        collect_squared_lengths(static_cast<std::uint32_t>(v), values);
        if (values.empty()) return;
        const double short_sq = kRounding * *std::ranges::max_element(values) / (size * size);
        const auto num_short =
            std::ranges::count_if(values, [&](double value) { return value <= short_sq; });
        uneven[v] = 2 * static_cast<std::size_t>(num_short) > values.size() ? 1 : 0;
    });
    return uneven;
}

std::vector<std::uint32_t> LocalEdges::large_faces(double size) const
{
    const std::vector<std::uint8_t> uneven = uneven_vertices(size);
    return parallel_collect<std::uint32_t>(faces_.size(), [&](std::size_t face, auto& large) {
        const auto& [a, b, c] = faces_[face];
        if (uneven[a] + uneven[b] + uneven[c] >= 2)
            large.push_back(static_cast<std::uint32_t>(face));
    });
}

} // namespace vcarve
