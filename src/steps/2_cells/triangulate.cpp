#include "steps/2_cells/triangulate.h"

#include "base/freed_memory.h"
#include "base/index_limit.h"
#include "base/parallel.h"
#include "base/parallel_invoke.h"
#include "base/parallel_rows.h"
#include "base/random_number.h"
#include "base/unset_array.h"
#include "vcarve/error.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <fmt/core.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>
#include <stdexcept>

namespace vcarve {

namespace {

/// Below this many points CGAL's parallel insertion loses against its sequential one (measured).
constexpr std::size_t kParallelFromPoints = 50'000;

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
using CellBase =
    CGAL::Triangulation_cell_base_with_info_3<Index, Kernel,
                                              CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;

template <typename Concurrency>
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase, Concurrency>>;

/// The share of the time that the insertion of points takes; the rest is copying cells.
constexpr double kInsertion = 0.8;

Kernel::Point_3 to_point(const Eigen::Vector3d& position)
{
    return {position.x(), position.y(), position.z()};
}

/// In which round a point is inserted: the last one takes three quarters of all points, the one
/// before three quarters of the rest, and so on, by chance.
std::uint32_t insertion_round(std::size_t point, std::uint32_t num_rounds)
{
    constexpr std::uint64_t kSeed = 0;
    std::uint32_t round = num_rounds - 1;
    for (double chance = random_number(kSeed, point); chance < 0.25 && round > 0; chance *= 4.0)
        --round;
    return round;
}

/// The numbers of points that follow each other in space, in the order that suits insertion: random
/// at large, near each other in the small (Amenta, Choi, Rote, "Incremental constructions con
/// BRIO", 2003).
UnsetArray<std::uint32_t> insertion_order(std::size_t count)
{
    constexpr std::size_t kFirstRound = 16; // points or more
    std::uint32_t num_rounds = 1;
    while (count >> (2 * num_rounds) >= kFirstRound)
        ++num_rounds;
    return gather_rows(count, num_rounds,
                       [&](std::size_t i, const auto& visit) {
                           visit(insertion_round(i, num_rounds), static_cast<std::uint32_t>(i));
                       })
        .items;
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
Cell unnumbered_cell(const CellHandle& cell)
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

/// The cells of a triangulation, numbered in the order CGAL keeps them, which may differ from run
/// to run. Memory: the place of one cell a run.
template <typename Triangulation>
class NumberedCells {
  public:
    /// Numbers from both ends at once, since CGAL gives no other way to share that.
    explicit NumberedCells(const Triangulation& triangulation)
        : count_(triangulation.tds().cells().size()), firsts_((count_ + kRun - 1) / kRun)
    {
        const auto number = [&](std::size_t i, const auto& cell) {
            cell->info() = static_cast<Index>(i);
            if (i % kRun == 0) firsts_[i / kRun] = cell;
        };
        const std::size_t half = count_ / 2;
        parallel_invoke(
            [&] {
                auto cell = triangulation.all_cells_begin();
                for (std::size_t i = 0; i < half; ++i)
                    number(i, cell++);
            },
            [&] {
                auto cell = triangulation.all_cells_end();
                for (std::size_t i = count_; i-- > half;)
                    number(i, --cell);
            });
    }

    std::size_t size() const { return count_; }

    /// Calls visit(i, cell) for all cells, from many threads.
    template <typename Visit>
    void for_each(const Visit& visit) const
    {
        const auto visit_run = [&](std::size_t run) {
            auto cell = firsts_[run];
            const std::size_t last = std::min(count_, (run + 1) * kRun);
            for (std::size_t i = run * kRun; i < last; ++i)
                visit(i, cell++);
        };
        parallel_for(firsts_.size(), visit_run, 1);
    }

  private:
    static constexpr std::size_t kRun = 1024; ///< cells
    std::size_t count_;
    std::vector<typename Triangulation::All_cells_iterator> firsts_; ///< of the runs
};

/// All cells, in that order.
template <typename Triangulation>
UnsetArray<Cell> unnumbered_cells(const Triangulation& triangulation, const Progress& progress)
{
    const NumberedCells<Triangulation> numbered(triangulation);
    progress.tell(0.5);
    UnsetArray<Cell> cells(numbered.size());
    numbered.for_each([&](std::size_t i, const auto& cell) { cells[i] = unnumbered_cell(cell); });
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
UnsetArray<Index> canonical_order(const UnsetArray<Cell>& cells, std::size_t num_vertices)
{
    RowTable bins = gather_rows(cells.size(), num_vertices, [&](std::size_t i, const auto& visit) {
        visit(smallest_vertex(cells[i]), static_cast<Index>(i));
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

/// Puts the cells in canonical order.
void fill_cells(const UnsetArray<Cell>& unnumbered, TetMesh& mesh, std::size_t num_vertices,
                const Progress& progress)
{
    const UnsetArray<Index> order = canonical_order(unnumbered, num_vertices);
    progress.tell(0.5);
    UnsetArray<Index> numbers(order.size());
    parallel_for(order.size(), [&](std::size_t i) { numbers[order[i]] = static_cast<Index>(i); });
    mesh.cells.resize(order.size());
    parallel_for(order.size(), [&](std::size_t i) {
        Cell cell = unnumbered[order[i]];
        for (Index& neighbor : cell.neighbors) {
            neighbor = numbers[neighbor];
        }
        mesh.cells[i] = cell;
    });
    progress.tell(0.7);
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
TetMesh flatten(Triangulation& triangulation, const Scene& scene, const Progress& progress)
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
    const UnsetArray<Cell> unnumbered = unnumbered_cells(triangulation, progress.part(0.0, 0.4));
    progress.tell(0.4);
    triangulation.clear();
    return_freed_memory();
    progress.tell(0.6);
    TetMesh mesh;
    fill_cells(unnumbered, mesh, scene.num_points(), progress.part(0.6, 0.9));
    progress.tell(0.9);
    mesh.positions = scene.positions;
    find_cells_of_vertices(mesh);
    return mesh;
}

/// Inserts point after point. CGAL's insertion of many at once does the same, but does not tell how
/// far it is.
TetMesh triangulate_sequentially(const Scene& scene, const Progress& progress)
{
    using Triangulation = Delaunay<CGAL::Sequential_tag>;
    constexpr std::size_t kToldEvery = 256;
    Triangulation triangulation;
    {
        const UnsetArray<std::uint32_t> order = insertion_order(scene.num_points());
        Triangulation::Vertex_handle hint;
        for (std::size_t i = 0; i < order.size(); ++i) {
            hint = triangulation.insert(to_point(scene.positions[order[i]]), hint);
            hint->info() = order[i];
            if (i % kToldEvery == 0) progress.part(0.0, kInsertion).tell(i, order.size());
        }
    }
    return flatten(triangulation, scene, progress.part(kInsertion, 1.0));
}

/// Inserts points from many threads. A thread that does not get hold of all cells it would change
/// lets go of them and tries again, as in CGAL's own insertion of many points at once.
template <typename Triangulation>
void insert_in_parallel(Triangulation& triangulation, const std::vector<Eigen::Vector3d>& positions,
                        std::span<const std::uint32_t> order, const Progress& progress)
{
    using VertexHandle = typename Triangulation::Vertex_handle;
    const auto try_insert = [&](Index number, VertexHandle& hint) {
        const Kernel::Point_3 point = to_point(positions[number]);
        bool has_all_cells = false;
        VertexHandle vertex;
        if (triangulation.try_lock_vertex(hint) && triangulation.try_lock_point(point)) {
            vertex = triangulation.insert(point, hint, &has_all_cells);
        }
        triangulation.unlock_all_elements();
        if (!has_all_cells) return false;
        vertex->info() = number;
        hint = vertex;
        return true;
    };
    tbb::enumerable_thread_specific<VertexHandle> hints(triangulation.finite_vertices_begin());
    parallel_for_ranges(
        order.size(), progress,
        [&](std::size_t first, std::size_t last) {
            VertexHandle& hint = hints.local();
            for (std::size_t i = first; i < last; ++i) {
                while (!try_insert(order[i], hint)) {
                }
            }
        },
        256);
}

TetMesh triangulate_in_parallel(const Scene& scene, const Progress& progress)
{
    using Triangulation = Delaunay<CGAL::Parallel_tag>;
    constexpr int kLockCellsPerAxis = 50;     // CGAL's own choice in its manual
    constexpr std::size_t kFirstPoints = 100; // so many, and until they span space, by one thread
    Triangulation::Lock_data_structure locks(box_of(scene), kLockCellsPerAxis);
    Triangulation triangulation(Kernel(), &locks);
    {
        const UnsetArray<std::uint32_t> order = insertion_order(scene.num_points());
        std::size_t first = 0;
        Triangulation::Vertex_handle hint;
        for (; first < order.size() && (first < kFirstPoints || triangulation.dimension() < 3);
             ++first) {
            hint = triangulation.insert(to_point(scene.positions[order[first]]), hint);
            hint->info() = order[first];
        }
        insert_in_parallel(triangulation, scene.positions, std::span(order).subspan(first),
                           progress.part(0.0, kInsertion));
    }
    return flatten(triangulation, scene, progress.part(kInsertion, 1.0));
}

} // namespace

TetMesh triangulate(const Scene& scene, const Progress& progress)
{
    if (scene.num_points() < 4) {
        throw InputError(fmt::format("{} point{} passed the filter; a surface needs at least four "
                                     "that do not lie in one plane",
                                     scene.num_points(), scene.num_points() == 1 ? "" : "s"));
    }
    const bool pays =
        scene.num_points() >= kParallelFromPoints && tbb::this_task_arena::max_concurrency() > 1;
    return pays ? triangulate_in_parallel(scene, progress)
                : triangulate_sequentially(scene, progress);
}

} // namespace vcarve
