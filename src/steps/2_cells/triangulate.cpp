#include "steps/2_cells/triangulate.h"

#include "base/freed_memory.h"
#include "base/index_limit.h"
#include "base/parallel.h"
#include "base/parallel_invoke.h"
#include "base/unset_array.h"
#include "steps/2_cells/canonical_cells.h"
#include "steps/2_cells/delaunay.h"
#include "steps/2_cells/insertion_order.h"
#include "steps/2_cells/refusals.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <span>

namespace vcarve {

namespace {

/// Below this many points CGAL's parallel insertion loses against its sequential one (measured).
constexpr std::size_t kParallelFromPoints = 50'000;

/// The share of the time that the insertion of points takes; the rest is copying cells.
constexpr double kInsertion = 0.8;

CGAL::Bbox_3 box_of(const Scene& scene)
{
    CGAL::Bbox_3 box;
    for (const Eigen::Vector3d& p : scene.positions) {
        box += CGAL::Bbox_3(p.x(), p.y(), p.z(), p.x(), p.y(), p.z());
    }
    return box;
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
            cell->info().value = static_cast<Index>(i);
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
UnsetArray<Cell> unordered_cells(const Triangulation& triangulation, const Progress& progress)
{
    const NumberedCells<Triangulation> numbered(triangulation);
    progress.tell(0.5);
    UnsetArray<Cell> cells(numbered.size());
    numbered.for_each([&](std::size_t i, const auto& cell) { cells[i] = unordered_cell(cell); });
    return cells;
}

/// Copies the cells of a triangulation to flat arrays and clears it on the way, so that only one
/// copy of the cells lives beside it.
template <typename Triangulation>
TetMesh flatten(Triangulation& triangulation, const Scene& scene, const Progress& progress)
{
    if (triangulation.dimension() < 3) throw all_in_one_plane(scene.num_points());
    require_indexable(triangulation.number_of_cells(), kMostIndices, "cells");
    if (triangulation.number_of_vertices() != scene.num_points()) {
        throw two_at_one_place();
    }
    triangulation.infinite_vertex()->info() = kInfinite;
    const UnsetArray<Cell> unordered = unordered_cells(triangulation, progress.part(0.0, 0.4));
    progress.tell(0.4);
    triangulation.clear();
    return_freed_memory();
    progress.tell(0.6);
    TetMesh mesh;
    mesh.cells = in_canonical_order(unordered, 0, scene.num_points(), progress.part(0.6, 0.9));
    progress.tell(0.9);
    mesh.positions = scene.positions;
    complete(mesh);
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
    require_four_points(scene.num_points());
    const bool pays =
        scene.num_points() >= kParallelFromPoints && tbb::this_task_arena::max_concurrency() > 1;
    return pays ? triangulate_in_parallel(scene, progress)
                : triangulate_sequentially(scene, progress);
}

} // namespace vcarve
