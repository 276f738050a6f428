#include "steps/3_cells/delaunay.h"

#include "base/arrays.h"
#include "base/numbers.h"
#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <utility>

namespace vcarve {

namespace {

Cell unordered_cell(Triangulation::Cell_handle cell)
{
    std::array<int, 4> sources = {0, 1, 2, 3};
    std::array<Index, 4> found{};
    for (int i = 0; i < 4; ++i) {
        found[i] = cell->vertex(i)->info();
    }
    // Sort by swaps. Each swap inverts the orientation, so an odd number needs one more.
    bool is_odd = false;
    for (int i = 1; i < 4; ++i) {
        for (int j = i; j > 0 && found[sources[j]] < found[sources[j - 1]]; --j) {
            std::swap(sources[j], sources[j - 1]);
            is_odd = !is_odd;
        }
    }
    if (is_odd) {
        std::swap(sources[0], sources[1]);
    }
    Cell result{};
    for (int i = 0; i < 4; ++i) {
        result.vertices[i] = found[sources[i]];
        result.neighbors[i] = cell->neighbor(sources[i])->info().value;
    }
    return result;
}

Index smallest_vertex(const Cell& cell)
{
    return std::min(cell.vertices[0], cell.vertices[1]);
}

/// The cells sorted by smallest vertex, then by comes_before(), without cells of other vertices.
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

/// The slot of a neighbor. It is unique, because cells that shared two facets would share all
/// vertices.
int slot_of_neighbor(const Cell& cell, Index neighbor)
{
    const auto found = std::find(cell.neighbors.begin(), cell.neighbors.end(), neighbor);
    return static_cast<int>(found - cell.neighbors.begin());
}

/// The random round in which a point is inserted. The last round has three quarters of all points,
/// the one before three quarters of the rest, and so on.
std::uint32_t insertion_round(std::size_t point, std::uint32_t num_rounds)
{
    std::uint32_t round = num_rounds - 1;
    for (double chance = random_number(0, point); chance < 0.25 && round > 0; chance *= 4.0)
        --round;
    return round;
}

} // namespace

UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress)
{
    Index count = 0;
    for (const Triangulation::Cell_handle cell : triangulation.all_cell_handles())
        cell->info().value = count++;
    progress.report(0.5);
    UnsetArray<Cell> cells;
    cells.reserve(count);
    for (const Triangulation::Cell_handle cell : triangulation.all_cell_handles())
        cells.push_back(unordered_cell(cell));
    return cells;
}

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
    progress.report(0.6);
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

UnsetArray<std::uint32_t> insertion_order(std::size_t count)
{
    constexpr std::size_t kFirstRound = 16; // minimum number of points
    std::uint32_t num_rounds = 1;
    while (count >> (2 * num_rounds) >= kFirstRound)
        ++num_rounds;
    return gather_rows(count, num_rounds,
                       [&](std::size_t i, const auto& visit) {
                           visit(insertion_round(i, num_rounds), static_cast<std::uint32_t>(i));
                       })
        .items;
}

} // namespace vcarve
