#include "surface/edge_table.h"

#include "base/parallel.h"

#include <algorithm>

namespace vcarve {
namespace {

std::uint32_t lower_end(std::span<const Face> faces, Side side)
{
    return std::min(tail(faces, side), head(faces, side));
}

std::uint32_t higher_end(std::span<const Face> faces, Side side)
{
    return std::max(tail(faces, side), head(faces, side));
}

template <typename Visit>
void for_each_side(std::span<const Face> faces, const Visit& visit)
{
    for (Side side = 0; side < 3 * faces.size(); ++side) {
        if (!is_degenerate(faces[side / 3])) visit(side);
    }
}

} // namespace

EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices)
{
    // Counting sort by the lower end.
    std::vector<std::uint32_t> ends(num_vertices + 1, 0);
    for_each_side(faces, [&](Side side) { ++ends[lower_end(faces, side) + 1]; });
    for (std::size_t v = 0; v < num_vertices; ++v) {
        ends[v + 1] += ends[v];
    }
    EdgeTable edges;
    edges.sides.resize(ends.back());
    for_each_side(faces, [&](Side side) { edges.sides[ends[lower_end(faces, side)]++] = side; });

    // ends[v] is now where the sides of v end. Each vertex sorts its few sides by the higher end.
    parallel_for(num_vertices, [&](std::size_t v) {
        std::sort(edges.sides.begin() + (v == 0 ? 0 : ends[v - 1]), edges.sides.begin() + ends[v],
                  [&](Side a, Side b) {
                      const std::uint32_t end_a = higher_end(faces, a);
                      const std::uint32_t end_b = higher_end(faces, b);
                      return end_a != end_b ? end_a < end_b : a < b;
                  });
    });

    // An edge begins where either end changes.
    for (std::uint32_t i = 0; i < edges.sides.size(); ++i) {
        const Side side = edges.sides[i];
        const bool begins = i == 0 ||
                            lower_end(faces, side) != lower_end(faces, edges.sides[i - 1]) ||
                            higher_end(faces, side) != higher_end(faces, edges.sides[i - 1]);
        if (begins) edges.begins.push_back(i);
    }
    edges.begins.push_back(static_cast<std::uint32_t>(edges.sides.size()));
    return edges;
}

} // namespace vcarve
