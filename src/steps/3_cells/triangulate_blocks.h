#pragma once

#include "base/progress.h"
#include "model/tet_mesh.h"
#include "steps/3_cells/block_cells.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <functional>
#include <optional>

namespace vcarve {

/// Gives a block's cells: what make() returns, or what it returned in an earlier run. Called from
/// many threads.
using KeepBlock =
    std::function<BlockCells(std::size_t block, const std::function<BlockCells()>& make)>;

/// How a triangulation is cut.
struct Blocks {
    std::size_t count = 1;
    KeepBlock keep = [](std::size_t, const auto& make) { return make(); };
    std::size_t first = 0; ///< of a share: the first block it has, and
    std::size_t step = 1;  ///< every so many-th from there on
    CellLimit limit{};
};

/// What triangulate() gives, to the last bit, made in so many blocks: runs of points that follow
/// each other, each triangulated by itself with a few points of the others (see block_cells.h).
/// As many blocks are in work at a time as there are threads. Needs points that follow each other
/// in space, as spatial_sort() puts them; throws as triangulate() does. Nothing where points lie on
/// common spheres or planes, or next to them, as on a ball, and so many that blocks would take far
/// too long; triangulate() takes these. Cost: a block takes in more points of others the smaller it
/// is; of 100,000 points and more, less than a fifth. Memory: CGAL's structure of the blocks in
/// work, and the cells twice. Throws
/// InputError where there are more cells than the limit says.
std::optional<TetMesh> triangulate_in_blocks(const Scene& scene, const Blocks& blocks,
                                             const Progress& progress = {});

/// Makes the blocks of a share only, and hands them to `keep`, which must remember them; what it
/// returns is not looked at. Where one gives up, see above, all are left to
/// triangulate_in_blocks().
void triangulate_share(const Scene& scene, const Blocks& share, const Progress& progress = {});

} // namespace vcarve
