#include "mesh/edge_table.h"

#include "base/arrays.h"
#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

std::uint32_t higher_end(std::span<const Face> faces, HalfEdge half_edge)
{
    return std::max(tail(faces, half_edge), head(faces, half_edge));
}

/// The half-edges of non-degenerate faces, grouped by their lower vertex.
RowTable half_edges_by_lower_end(std::span<const Face> faces, std::size_t num_vertices)
{
    return gather_rows(faces.size(), num_vertices, [&](std::size_t face, const auto& visit) {
        if (is_degenerate(faces[face])) return;
        const auto& [a, b, c] = faces[face];
        const HalfEdge first = static_cast<HalfEdge>(3 * face);
        visit(std::min(a, b), first);
        visit(std::min(b, c), first + 1);
        visit(std::min(c, a), first + 2);
    });
}

/// Sorts half-edges with the same lower vertex by the higher vertex, then by number. Flags the
/// first half-edge of each edge.
void sort_half_edges(std::span<const Face> faces, std::span<HalfEdge> half_edges,
                     std::span<char> begins_edge, std::vector<std::uint64_t>& keys)
{
    keys.clear();
    for (const HalfEdge half_edge : half_edges) {
        keys.push_back((std::uint64_t{higher_end(faces, half_edge)} << 32U) | half_edge);
    }
    std::ranges::sort(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
        half_edges[i] = static_cast<HalfEdge>(keys[i]);
        begins_edge[i] = i == 0 || (keys[i - 1] >> 32U) != (keys[i] >> 32U) ? 1 : 0;
    }
}

} // namespace

EdgeTable gather_edges(std::span<const Face> faces, std::size_t num_vertices)
{
    auto [ends, half_edges] = half_edges_by_lower_end(faces, num_vertices);
    EdgeTable edges;
    edges.half_edges = std::move(half_edges);

    // Sort the few half-edges of each vertex by the higher vertex.
    std::vector<char> begins_edge(edges.half_edges.size());
    parallel_for_ranges(num_vertices, [&, &ends = ends](std::size_t first, std::size_t last) {
        std::vector<std::uint64_t> keys;
        for (std::size_t v = first; v != last; ++v) {
            const std::size_t begin = v == 0 ? 0 : ends[v - 1];
            const std::size_t count = ends[v] - begin;
            if (count == 0) continue;
            sort_half_edges(faces, std::span(edges.half_edges).subspan(begin, count),
                            std::span(begins_edge).subspan(begin, count), keys);
        }
    });
    edges.begins =
        parallel_collect<std::uint32_t>(begins_edge.size(), [&](std::size_t i, auto& begins) {
            if (begins_edge[i] != 0) begins.push_back(static_cast<std::uint32_t>(i));
        });
    edges.begins.push_back(static_cast<std::uint32_t>(edges.half_edges.size()));
    return edges;
}

} // namespace vcarve
