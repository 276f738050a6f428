#include "tetra/triangulate.h"

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

/// Below this many points CGAL's parallel insertion loses against its sequential one (measured).
constexpr std::size_t kParallelFromPoints = 50'000;

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

/// The vertices of a cell in canonical order, and where each came from in CGAL's cell.
struct CanonicalCell {
    std::array<Index, 4> vertices;
    std::array<int, 4> sources;
};

template <typename CellHandle>
CanonicalCell canonical(CellHandle cell)
{
    CanonicalCell result{{}, {0, 1, 2, 3}};
    std::array<Index, 4> found{};
    for (int i = 0; i < 4; ++i) {
        found[i] = cell->vertex(i)->info();
    }
    // Sort by exchanging; each exchange turns the cell inside out.
    bool is_odd = false;
    for (int i = 1; i < 4; ++i) {
        for (int j = i; j > 0 && found[result.sources[j]] < found[result.sources[j - 1]]; --j) {
            std::swap(result.sources[j], result.sources[j - 1]);
            is_odd = !is_odd;
        }
    }
    if (is_odd) {
        std::swap(result.sources[0], result.sources[1]);
    }
    for (int i = 0; i < 4; ++i) {
        result.vertices[i] = found[result.sources[i]];
    }
    return result;
}

Index smallest_vertex(const CanonicalCell& cell)
{
    return std::min(cell.vertices[0], cell.vertices[1]);
}

std::array<Index, 4> sorted_vertices(const CanonicalCell& cell)
{
    std::array<Index, 4> vertices = cell.vertices;
    std::sort(vertices.begin(), vertices.end());
    return vertices;
}

/// Cells of the triangulation in canonical order: binned by smallest vertex, each bin sorted.
template <typename Triangulation>
std::vector<typename Triangulation::Cell_handle> cells_in_order(const Triangulation& triangulation)
{
    using CellHandle = typename Triangulation::Cell_handle;
    std::vector<std::size_t> begins(triangulation.number_of_vertices() + 2, 0);
    std::vector<CellHandle> found;
    for (auto cell = triangulation.all_cells_begin(); cell != triangulation.all_cells_end();
         ++cell) {
        found.push_back(cell);
        ++begins[smallest_vertex(canonical(CellHandle(cell))) + 2];
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<CellHandle> order(found.size());
    for (const CellHandle cell : found) {
        order[begins[smallest_vertex(canonical(cell)) + 1]++] = cell;
    }
    parallel_for(triangulation.number_of_vertices(), [&](std::size_t vertex) {
        std::sort(order.begin() + static_cast<std::ptrdiff_t>(begins[vertex]),
                  order.begin() + static_cast<std::ptrdiff_t>(begins[vertex + 1]),
                  [](CellHandle a, CellHandle b) {
                      return sorted_vertices(canonical(a)) < sorted_vertices(canonical(b));
                  });
    });
    return order;
}

/// Copies cells to flat arrays.
template <typename Triangulation>
void copy_cells(const Triangulation& triangulation, TetMesh& mesh)
{
    const auto order = cells_in_order(triangulation);
    parallel_for(order.size(), [&](std::size_t i) { order[i]->info() = static_cast<Index>(i); });
    mesh.cells.resize(order.size());
    mesh.mirrors.resize(order.size());
    parallel_for(order.size(), [&](std::size_t i) {
        const CanonicalCell cell = canonical(order[i]);
        Cell& copy = mesh.cells[i];
        copy.vertices = cell.vertices;
        mesh.mirrors[i] = 0;
        for (int slot = 0; slot < 4; ++slot) {
            const auto neighbor = order[i]->neighbor(cell.sources[slot]);
            copy.neighbors[slot] = neighbor->info();
            const int mirror_source = neighbor->index(order[i]);
            const auto sources = canonical(neighbor).sources;
            const int mirror = static_cast<int>(
                std::find(sources.begin(), sources.end(), mirror_source) - sources.begin());
            mesh.mirrors[i] |= static_cast<std::uint8_t>(mirror << (2 * slot));
        }
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
    TetMesh mesh;
    copy_cells(triangulation, mesh);
    mesh.positions = scene.positions;
    find_cells_of_vertices(mesh);
    return mesh;
}

TetMesh triangulate_sequentially(const Scene& scene)
{
    const auto points = numbered_points(scene);
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
