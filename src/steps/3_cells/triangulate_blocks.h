#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/limits.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <optional>

namespace vcarve {

/// The division of a triangulation into blocks.
struct Blocks {
    std::size_t count = 1;
    std::size_t most_cells = kAnyCells;
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

} // namespace vcarve
