#include "surface/edge_table.h"

#include "base/parallel.h"

#include <algorithm>
#include <numeric>

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

/// Calls visit(lower end, side) for the sides of faces that are not degenerate.
template <typename Visit>
void for_each_side(std::span<const Face> faces, const Visit& visit)
{
    for (std::size_t face = 0; face < faces.size(); ++face) {
        const auto& [a, b, c] = faces[face];
        if (is_degenerate(faces[face])) continue;
        const Side first = static_cast<Side>(3 * face);
        visit(std::min(a, b), first);
        visit(std::min(b, c), first + 1);
        visit(std::min(c, a), first + 2);
    }
}

/// Sorts the sides with one lower end by the higher one, then by number.
void sort_sides(std::span<const Face> faces, std::span<Side> sides,
                std::vector<std::uint64_t>& keys)
{
    keys.clear();
    for (const Side side : sides) {
        keys.push_back((std::uint64_t{higher_end(faces, side)} << 32U) | side);
    }
    std::ranges::sort(keys);
    std::ranges::transform(keys, sides.begin(),
                           [](std::uint64_t key) { return static_cast<Side>(key); });
}

} // namespace

EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices)
{
    // Counting sort by the lower end.
    std::vector<std::uint32_t> ends(num_vertices + 1, 0);
    for_each_side(faces, [&](std::uint32_t lower, Side) { ++ends[lower + 1]; });
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    EdgeTable edges;
    edges.sides.resize(ends.back());
    for_each_side(faces,
                  [&](std::uint32_t lower, Side side) { edges.sides[ends[lower]++] = side; });

    // ends[v] is now where the sides of v end. Each vertex sorts its few sides by the higher end.
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, num_vertices, 1024), [&](const auto& vertices) {
            std::vector<std::uint64_t> keys;
            for (std::size_t v = vertices.begin(); v != vertices.end(); ++v) {
                const std::uint32_t begin = v == 0 ? 0 : ends[v - 1];
                sort_sides(faces, std::span(edges.sides).subspan(begin, ends[v] - begin), keys);
            }
        });

    // An edge begins where either end changes.
    const auto same_edge = [&](Side a, Side b) {
        return lower_end(faces, a) == lower_end(faces, b) &&
               higher_end(faces, a) == higher_end(faces, b);
    };
    edges.begins =
        parallel_collect<std::uint32_t>(edges.sides.size(), [&](std::size_t i, auto& begins) {
            if (i == 0 || !same_edge(edges.sides[i - 1], edges.sides[i])) {
                begins.push_back(static_cast<std::uint32_t>(i));
            }
        });
    edges.begins.push_back(static_cast<std::uint32_t>(edges.sides.size()));
    return edges;
}

} // namespace vcarve
