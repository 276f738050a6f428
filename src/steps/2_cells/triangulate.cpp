#include "steps/2_cells/triangulate.h"

#include "base/error.h"
#include "base/index_limit.h"
#include "base/parallel.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/core.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace vcarve {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<Index, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;

template <typename Concurrency>
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>>;

std::vector<std::pair<Kernel::Point_3, Index>> numbered_points(const Scene& scene)
{
    std::vector<std::pair<Kernel::Point_3, Index>> points;
    points.reserve(scene.num_points());
    for (const Eigen::Vector3d& p : scene.positions) {
        points.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()),
                            static_cast<Index>(points.size()));
    }
    return points;
}

CGAL::Bbox_3 box_of(const Scene& scene)
{
    CGAL::Bbox_3 box;
    for (const Eigen::Vector3d& p : scene.positions) {
        box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    return box;
}

/// A cell with its vertices as TetMesh has them, its neighbours still as CGAL keeps them.
template <typename CellHandle>
Cell unnumbered_cell(CellHandle cell)
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
        result.neighbors[i] = cell->neighbor(sources[i])->info();
    }
    return result;
}

/// All cells, in the order CGAL keeps them, which may differ from run to run.
template <typename Triangulation>
std::vector<Cell> unnumbered_cells(const Triangulation& triangulation)
{
    using CellHandle = typename Triangulation::Cell_handle;
    std::vector<CellHandle> handles;
    handles.reserve(triangulation.tds().cells().size());
    for (CellHandle cell : triangulation.all_cell_handles()) {
        cell->info() = static_cast<Index>(handles.size());
        handles.push_back(cell);
    }
    std::vector<Cell> cells(handles.size());
    parallel_for(handles.size(), [&](std::size_t i) { cells[i] = unnumbered_cell(handles[i]); });
    return cells;
}

Index smallest_vertex(const Cell& cell)
{
    return std::min(cell.vertices[0], cell.vertices[1]);
}

/// Whether the sorted vertices of a cell come first. Only the first two may stand exchanged.
bool comes_before(const Cell& a, const Cell& b)
{
    const auto key = [](const Cell& cell) {
        const auto [low, high] = std::minmax(cell.vertices[0], cell.vertices[1]);
        return std::array<Index, 4>{low, high, cell.vertices[2], cell.vertices[3]};
    };
    return key(a) < key(b);
}

/// The cells in canonical order: binned by smallest vertex, each bin sorted.
std::vector<Index> canonical_order(const std::vector<Cell>& cells, std::size_t num_vertices)
{
    std::vector<Index> ends(num_vertices + 1, 0);
    for (const Cell& cell : cells) {
        ++ends[smallest_vertex(cell) + 1];
    }
    std::partial_sum(ends.begin(), ends.end(), ends.begin());
    std::vector<Index> order(cells.size());
    for (Index i = 0; i < cells.size(); ++i) {
        order[ends[smallest_vertex(cells[i])]++] = i;
    }
    parallel_for(num_vertices, [&](std::size_t vertex) {
        const Index begin = vertex == 0 ? 0 : ends[vertex - 1];
        std::sort(order.begin() + begin, order.begin() + ends[vertex],
                  [&](Index a, Index b) { return comes_before(cells[a], cells[b]); });
    });
    return order;
}

/// Where a cell has another one as neighbour, which is in one place only: cells that shared two
/// facets would share all vertices.
int slot_of_neighbor(const Cell& cell, Index neighbor)
{
    const auto found = std::find(cell.neighbors.begin(), cell.neighbors.end(), neighbor);
    return static_cast<int>(found - cell.neighbors.begin());
}

/// Puts the cells in canonical order.
void fill_cells(const std::vector<Cell>& unnumbered, TetMesh& mesh, std::size_t num_vertices)
{
    const std::vector<Index> order = canonical_order(unnumbered, num_vertices);
    std::vector<Index> numbers(order.size());
    parallel_for(order.size(), [&](std::size_t i) { numbers[order[i]] = static_cast<Index>(i); });
    mesh.cells.resize(order.size());
    parallel_for(order.size(), [&](std::size_t i) {
        Cell cell = unnumbered[order[i]];
        for (Index& neighbor : cell.neighbors) {
            neighbor = numbers[neighbor];
        }
        mesh.cells[i] = cell;
    });
    mesh.mirrors.resize(order.size());
    parallel_for(order.size(), [&](std::size_t i) {
        unsigned mirrors = 0;
        for (int slot = 0; slot < 4; ++slot) {
            const Cell& beyond = mesh.cells[mesh.cells[i].neighbors[slot]];
            const int mirror = slot_of_neighbor(beyond, static_cast<Index>(i));
            mirrors |= static_cast<unsigned>(mirror) << (2 * slot);
        }
        mesh.mirrors[i] = static_cast<std::uint8_t>(mirrors);
    });
}

void find_cells_of_vertices(TetMesh& mesh)
{
    mesh.cell_of_vertex.assign(mesh.positions.size(), kInfinite);
    for (std::size_t i = mesh.cells.size(); i-- > 0;) {
        if (!mesh.cells[i].is_infinite()) {
            for (const Index vertex : mesh.cells[i].vertices) {
                mesh.cell_of_vertex[vertex] = static_cast<Index>(i);
            }
        }
    }
}

/// Copies the cells of a triangulation to flat arrays and clears it on the way, so that only one
/// copy of the cells lives beside it.
template <typename Triangulation>
TetMesh flatten(Triangulation& triangulation, const Scene& scene)
{
    if (triangulation.dimension() < 3) {
        throw InputError(fmt::format("the {} points that passed the filter all lie in one plane; a "
                                     "surface needs at least four that do not",
                                     scene.num_points()));
    }
    require_indexable(triangulation.number_of_cells(), kMostIndices, "cells");
    if (triangulation.number_of_vertices() != scene.num_points()) {
        throw std::logic_error("two points to triangulate lie at one place");
    }
    triangulation.infinite_vertex()->info() = kInfinite;
    const std::vector<Cell> unnumbered = unnumbered_cells(triangulation);
    triangulation.clear();
    TetMesh mesh;
    fill_cells(unnumbered, mesh, scene.num_points());
    mesh.positions = scene.positions;
    find_cells_of_vertices(mesh);
    return mesh;
}

TetMesh triangulate_sequentially(const Scene& scene)
{
    auto points = numbered_points(scene);
    Delaunay<CGAL::Sequential_tag> triangulation(points.begin(), points.end());
    return flatten(triangulation, scene);
}

TetMesh triangulate_in_parallel(const Scene& scene)
{
    using Triangulation = Delaunay<CGAL::Parallel_tag>;
    constexpr int kLockCellsPerAxis = 50; // CGAL's own choice in its manual
    Triangulation::Lock_data_structure locks(box_of(scene), kLockCellsPerAxis);
    auto points = numbered_points(scene);
    Triangulation triangulation(points.begin(), points.end(), &locks);
    points = {};
    return flatten(triangulation, scene);
}

} // namespace

TetMesh triangulate(const Scene& scene)
{
    if (scene.num_points() < 4) {
        throw InputError(fmt::format("{} point{} passed the filter; a surface needs at least four "
                                     "that do not lie in one plane",
                                     scene.num_points(), scene.num_points() == 1 ? "" : "s"));
    }
    const bool pays =
        scene.num_points() >= kParallelFromPoints && tbb::this_task_arena::max_concurrency() > 1;
    return pays ? triangulate_in_parallel(scene) : triangulate_sequentially(scene);
}

} // namespace vcarve
