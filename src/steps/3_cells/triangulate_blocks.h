#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/block_cells.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace vcarve {

/// Returns the cells of a block: the result of make(), in this or an earlier run. Called from many
/// threads.
using KeepBlock =
    std::function<BlockCells(std::size_t block, const std::function<BlockCells()>& make)>;

/// The division of a triangulation into blocks.
struct Blocks {
    std::size_t count = 1;
    KeepBlock keep = [](std::size_t, const auto& make) { return make(); };
    std::size_t first = 0; ///< the first block of a share
    std::size_t step = 1;  ///< the share has every `step`-th block from `first`
    CellLimit limit{};
};

/// Returns the result of triangulate(), byte-identical, made in blocks. A block is a run of
/// consecutive points, triangulated with a few points of others (see block_cells.h). Each thread
/// works on one block at a time. Points must be in the order of spatial_sort(). Returns nothing if
/// too many points lie on or near common spheres or planes, such as a ball. Blocks would then take
/// far too long, but triangulate() accepts these points. Cost: the smaller a block, the more points
/// of others it needs; less than a fifth for 100,000 points or more. Memory: CGAL's structure of
/// the blocks in progress, and twice the cells. Throws InputError like triangulate(), and if the
/// number of cells exceeds the limit.
std::optional<TetMesh> triangulate_in_blocks(const Scene& scene, const Blocks& blocks,
                                             const Progress& progress = {});

/// Makes only the blocks of a share and passes them to `keep`, which must store them; its result is
/// ignored. If a block gives up (see above), all are left to triangulate_in_blocks().
void triangulate_share(const Scene& scene, const Blocks& share, const Progress& progress = {});

} // namespace vcarve
