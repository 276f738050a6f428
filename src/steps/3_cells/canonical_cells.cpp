#include "steps/3_cells/canonical_cells.h"

#include "base/atomic_min.h"
#include "base/parallel.h"
#include "base/parallel_rows.h"
#include "steps/3_cells/delaunay.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vcarve {

namespace {

Index smallest_vertex(const Cell& cell)
{
    return std::min(cell.vertices[0], cell.vertices[1]);
}

/// Binned by smallest vertex, each bin sorted; without those of other vertices.
UnsetArray<Index> canonical_order(const UnsetArray<Cell>& cells, Index first_vertex,
                                  std::size_t num_vertices)
{
    RowTable bins = gather_rows(cells.size(), num_vertices, [&](std::size_t i, const auto& visit) {
        const Index smallest = smallest_vertex(cells[i]);
        if (smallest < first_vertex || smallest - first_vertex >= num_vertices) return;
        visit(smallest - first_vertex, static_cast<Index>(i));
    });
    parallel_for(num_vertices, [&](std::size_t vertex) {
        const Index begin = vertex == 0 ? 0 : bins.ends[vertex - 1];
        std::sort(bins.items.begin() + begin, bins.items.begin() + bins.ends[vertex],
                  [&](Index a, Index b) { return comes_before(cells[a], cells[b]); });
    });
    return std::move(bins.items);
}

/// Where a cell has another one as neighbour, which is in one place only: cells that shared two
/// facets would share all vertices.
int slot_of_neighbor(const Cell& cell, Index neighbor)
{
    const auto found = std::find(cell.neighbors.begin(), cell.neighbors.end(), neighbor);
    return static_cast<int>(found - cell.neighbors.begin());
}

} // namespace

bool comes_before(const Cell& a, const Cell& b)
{
    const auto key = [](const Cell& cell) {
        const auto [low, high] = std::minmax(cell.vertices[0], cell.vertices[1]);
        return std::array<Index, 4>{low, high, cell.vertices[2], cell.vertices[3]};
    };
    return key(a) < key(b);
}

UnsetArray<Cell> in_canonical_order(const UnsetArray<Cell>& cells, Index first_vertex,
                                    std::size_t num_vertices, const Progress& progress)
{
    const UnsetArray<Index> order = canonical_order(cells, first_vertex, num_vertices);
    progress.tell(0.6);
    UnsetArray<Index> numbers = filled_array<Index>(cells.size(), CellNumber::kNone);
    parallel_for(order.size(), [&](std::size_t i) { numbers[order[i]] = static_cast<Index>(i); });
    UnsetArray<Cell> ordered(order.size());
    parallel_for(order.size(), [&](std::size_t i) {
        Cell cell = cells[order[i]];
        for (Index& neighbor : cell.neighbors)
            neighbor = numbers[neighbor];
        ordered[i] = cell;
    });
    return ordered;
}

void complete(TetMesh& mesh)
{
    mesh.mirrors.resize(mesh.cells.size());
    parallel_for(mesh.cells.size(), [&](std::size_t i) {
        unsigned mirrors = 0;
        for (int slot = 0; slot < 4; ++slot) {
            const Cell& beyond = mesh.cells[mesh.cells[i].neighbors[slot]];
            const int mirror = slot_of_neighbor(beyond, static_cast<Index>(i));
            mirrors |= static_cast<unsigned>(mirror) << (2 * slot);
        }
        mesh.mirrors[i] = static_cast<std::uint8_t>(mirrors);
    });
    mesh.cell_of_vertex.assign(mesh.positions.size(), kInfinite);
    parallel_for(mesh.cells.size(), [&](std::size_t i) {
        if (mesh.cells[i].is_infinite()) return;
        for (const Index vertex : mesh.cells[i].vertices)
            atomic_min(mesh.cell_of_vertex[vertex], static_cast<Index>(i));
    });
}

} // namespace vcarve
