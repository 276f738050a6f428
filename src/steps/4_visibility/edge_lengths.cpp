#include "steps/4_visibility/edge_lengths.h"

#include "base/parallel.h"
#include "base/parallel_sort.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace vcarve {

namespace {

using Edge = std::uint64_t; ///< smaller vertex in the upper half, larger in the lower

/// Spreads edges evenly, so that taking those below a bound takes a fair sample.
std::uint64_t scattered(Edge edge)
{
    edge ^= edge >> 31U;
    edge *= 0x9e3779b97f4a7c15ULL;
    edge ^= edge >> 29U;
    edge *= 0xbf58476d1ce4e5b9ULL;
    return edge ^ (edge >> 32U);
}

constexpr std::array<std::array<int, 2>, 6> kCellEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

void add_sampled_edges(const Cell& cell, std::uint64_t one_in, std::vector<Edge>& edges)
{
    for (const auto& [i, j] : kCellEdges) {
        const auto [low, high] = std::minmax(cell.vertices[i], cell.vertices[j]);
        const Edge edge = (static_cast<Edge>(low) << 32U) | high;
        if (high != kInfinite && scattered(edge) % one_in == 0) {
            edges.push_back(edge);
        }
    }
}

std::vector<Edge> sampled_edges(const TetMesh& mesh)
{
    // The quartile is then known to a few per mille.
    constexpr std::size_t kCellsTakenWhole = 50'000;
    const std::uint64_t one_in = 1 + mesh.cells.size() / kCellsTakenWhole;
    auto edges = parallel_collect<Edge>(mesh.cells.size(), [&](std::size_t cell, auto& found) {
        add_sampled_edges(mesh.cells[cell], one_in, found);
    });
    parallel_sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

} // namespace

double short_edge_length(const TetMesh& mesh)
{
    std::vector<double> lengths;
    for (const Edge edge : sampled_edges(mesh)) {
        const auto low = static_cast<Index>(edge >> 32U);
        const auto high = static_cast<Index>(edge);
        lengths.push_back((mesh.positions[low] - mesh.positions[high]).norm());
    }
    if (lengths.empty()) {
        return 0.0;
    }
    const auto quarter = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
    std::nth_element(lengths.begin(), quarter, lengths.end());
    return *quarter;
}

} // namespace vcarve
