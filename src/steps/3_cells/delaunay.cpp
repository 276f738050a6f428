#include "steps/3_cells/delaunay.h"

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
    // Sort by exchanging; each exchange turns the cell inside out, and one more may turn it back.
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

} // namespace

UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress)
{
    Index count = 0;
    for (const Triangulation::Cell_handle cell : triangulation.all_cell_handles())
        cell->info().value = count++;
    progress.tell(0.5);
    UnsetArray<Cell> cells;
    cells.reserve(count);
    for (const Triangulation::Cell_handle cell : triangulation.all_cell_handles())
        cells.push_back(unordered_cell(cell));
    return cells;
}

} // namespace vcarve
