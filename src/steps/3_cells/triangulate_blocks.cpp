#include "steps/3_cells/triangulate_blocks.h"

#include "base/free_memory.h"
#include "base/numbers.h"
#include "base/parallel.h"
#include "steps/3_cells/block_cells.h"
#include "steps/3_cells/delaunay.h"
#include "steps/3_cells/limits.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

PointRun run_of(std::size_t block, std::size_t num_blocks, std::size_t num_points)
{
    return {block * num_points / num_blocks, (block + 1) * num_points / num_blocks};
}

/// Calls body(block) for all blocks from many threads. Rethrows the first exception at the end,
/// because an exception inside the loop makes oneTBB end other blocks' loops as if they were done.
template <typename Body>
void for_each_block(std::size_t count, const Body& body)
{
    std::atomic<bool> has_failed = false;
    std::exception_ptr failure;
    const auto guarded = [&](std::size_t block) {
        if (has_failed) return;
        try {
            body(block);
        } catch (...) {
            if (!has_failed.exchange(true)) failure = std::current_exception();
        }
    };
    parallel_for(count, guarded, 1);
    if (failure) std::rethrow_exception(failure);
}

std::size_t num_blocks(const Blocks& wanted, const Scene& scene)
{
    return std::clamp<std::size_t>(wanted.count, 1, scene.num_points());
}

std::vector<BlockCells> all_blocks(const Scene& scene, const std::vector<Index>& first,
                                   const Blocks& blocks, const Progress& progress)
{
    std::vector<BlockCells> made(num_blocks(blocks, scene));
    const PointTree tree(scene.positions);
    ProgressCount done(progress, scene.num_points());
    CellCount cells(blocks.most_cells);
    for_each_block(made.size(), [&](std::size_t block) {
        const PointRun own = run_of(block, made.size(), scene.num_points());
        BlockProgress reported(done, own.size());
        made[block] = block_cells(tree, first, own, cells, reported);
        reported.report(1.0);
    });
    return made;
}

/// The number of each block's first cell, and the number of all cells.
std::vector<std::size_t> first_cells(const std::vector<BlockCells>& blocks)
{
    std::vector<std::size_t> firsts{0};
    for (const BlockCells& block : blocks) {
        firsts.push_back(firsts.back() + block.cells.size());
    }
    return firsts;
}

/// The facets between blocks, with numbers of all cells. Each occurs twice in a row, once per side.
std::vector<OpenFacet> facets_between(std::vector<BlockCells>& blocks,
                                      const std::vector<std::size_t>& firsts)
{
    std::vector<OpenFacet> facets;
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        for (OpenFacet facet : std::exchange(blocks[block].open_facets, {})) {
            facet.cell += static_cast<Index>(firsts[block]);
            facets.push_back(facet);
        }
    }
    parallel_sort(facets, [](const OpenFacet& a, const OpenFacet& b) {
        return a.corners != b.corners ? a.corners < b.corners : a.cell < b.cell;
    });
    return facets;
}

/// The cells of all blocks in sequence, which is their canonical order.
UnsetArray<Cell> joined_cells(std::vector<BlockCells>& blocks,
                              const std::vector<std::size_t>& firsts)
{
    UnsetArray<Cell> cells(firsts.back());
    for (std::size_t block = 0; block < blocks.size(); ++block) {
        const UnsetArray<Cell> own = std::exchange(blocks[block].cells, {});
        parallel_for(own.size(), [&](std::size_t i) {
            Cell cell = own[i];
            for (Index& neighbor : cell.neighbors) {
                if (neighbor != kInfinite) neighbor += static_cast<Index>(firsts[block]);
            }
            cells[firsts[block] + i] = cell;
        });
    }
    return cells;
}

/// Connects the two cells at each facet between blocks.
void join_facets(const std::vector<OpenFacet>& facets, UnsetArray<Cell>& cells)
{
    if (facets.size() % 2 != 0) throw std::logic_error("a facet between blocks has only one cell");
    parallel_for(facets.size() / 2, [&](std::size_t i) {
        const OpenFacet& one = facets[2 * i];
        const OpenFacet& other = facets[2 * i + 1];
        if (one.corners != other.corners) {
            throw std::logic_error("a facet between blocks has only one cell");
        }
        cells[one.cell].neighbors[one.slot] = other.cell;
        cells[other.cell].neighbors[other.slot] = one.cell;
    });
}

/// The connected cells of all blocks.
TetMesh joined(std::vector<BlockCells>& blocks)
{
    const std::vector<std::size_t> firsts = first_cells(blocks);
    require_indexable(firsts.back(), kMostIndices, "cells");
    const std::vector<OpenFacet> facets = facets_between(blocks, firsts);
    TetMesh mesh;
    mesh.cells = joined_cells(blocks, firsts);
    join_facets(facets, mesh.cells);
    return mesh;
}

} // namespace

std::optional<TetMesh> triangulate_in_blocks(const Scene& scene, const Blocks& wanted,
                                             const Progress& progress)
{
    require_four_points(scene.num_points());
    const std::vector<Index> first = first_points(scene.positions);
    if (first.size() < 4) throw all_in_one_plane(scene.num_points());
    std::vector<BlockCells> blocks;
    try {
        blocks = all_blocks(scene, first, wanted, progress.part(0.0, 0.9));
    } catch (const TooManyTies&) {
        return_freed_memory(); // the caller triangulates at once, in this thread's own arena
        return std::nullopt;
    }
    return_freed_memory();
    TetMesh mesh = joined(blocks);
    progress.report(0.95);
    mesh.positions = scene.positions;
    complete(mesh);
    return mesh;
}

} // namespace vcarve
