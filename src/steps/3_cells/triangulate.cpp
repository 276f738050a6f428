#include "steps/3_cells/triangulate.h"

#include "base/arrays.h"
#include "base/free_memory.h"
#include "base/numbers.h"
#include "steps/3_cells/delaunay.h"
#include "steps/3_cells/limits.h"
#include "steps/3_cells/triangulate_blocks.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

/// Smaller blocks are slower than no blocks (measured), because they need many points of others.
constexpr std::size_t kLeastBlock = 10'000;

/// Larger blocks need fewer points of others, but more memory.
constexpr std::size_t kUsualBlock = 250'000;

/// Copies the cells of a triangulation to flat arrays. Clears the triangulation meanwhile, so that
/// it coexists with only one copy.
TetMesh flatten(Triangulation& triangulation, const Scene& scene, const Progress& progress)
{
    if (triangulation.dimension() < 3) throw all_in_one_plane(scene.num_points());
    require_indexable(triangulation.number_of_cells(), kMostIndices, "cells");
    if (triangulation.number_of_vertices() != scene.num_points()) {
        throw duplicate_position_error();
    }
    triangulation.infinite_vertex()->info() = kInfinite;
    const UnsetArray<Cell> unordered = unordered_cells(triangulation, progress.part(0.0, 0.4));
    progress.report(0.4);
    triangulation.clear();
    return_freed_memory();
    progress.report(0.6);
    TetMesh mesh;
    mesh.cells = in_canonical_order(unordered, 0, scene.num_points(), progress.part(0.6, 0.9));
    progress.report(0.9);
    mesh.positions = scene.positions;
    complete(mesh);
    return mesh;
}

} // namespace

std::size_t usual_blocks(std::size_t points, std::size_t threads)
{
    const std::size_t most = points / kLeastBlock;
    if (threads == 1 || most <= 1) return 1;
    return std::min(std::clamp(points / kUsualBlock, threads, 2 * threads), most);
}

TetMesh triangulate_at_once(const Scene& scene, const Progress& progress, std::size_t most_cells)
{
    // CGAL's insertion of many points at once does the same, but reports no progress.
    require_four_points(scene.num_points());
    const Progress inserting = progress.part(0.0, 0.8);
    Triangulation triangulation;
    {
        const UnsetArray<std::uint32_t> order = insertion_order(scene.num_points());
        Triangulation::Vertex_handle hint;
        CellCount count(most_cells);
        std::size_t cells = 0;
        for (std::size_t i = 0; i < order.size(); ++i) {
            hint = triangulation.insert(to_cgal(scene.positions[order[i]]), hint);
            hint->info() = order[i];
            count.change(cells, triangulation.number_of_cells());
            cells = triangulation.number_of_cells();
            if (i % Progress::kReportEvery == 0) inserting.report(i, order.size());
        }
    }
    return flatten(triangulation, scene, progress.part(0.8, 1.0));
}

TetMesh triangulate(const Scene& scene, const Progress& progress, std::size_t most_cells)
{
    const int threads = tbb::this_task_arena::max_concurrency();
    const std::size_t blocks = usual_blocks(scene.num_points(), static_cast<std::size_t>(threads));
    if (blocks > 1) {
        std::optional<TetMesh> mesh =
            triangulate_in_blocks(scene, {.count = blocks, .most_cells = most_cells}, progress);
        if (mesh) return std::move(*mesh);
    }
    return triangulate_at_once(scene, progress, most_cells);
}

} // namespace vcarve
