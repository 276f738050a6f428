#pragma once

#include "tiles/tile_surface.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace vcarve {

/// What was found at the seams of tiles.
struct SeamCounts {
    std::int64_t edges = 0;    ///< between faces of two tiles that agree
    std::int64_t open = 0;     ///< in one tile only, because the tiles disagree
    std::int64_t filled = 0;   ///< holes
    std::int64_t vertices = 0; ///< split
};

struct JoinedSurface {
    TriMesh mesh; ///< with normals
    SeamCounts seams;
    std::int64_t boundary_edges = 0;
};

/// Joins the surfaces of tiles at the vertices with equal names. Where two tiles disagree, holes of
/// at most `max_hole` edges are filled, and vertices are split, so that the result is as manifold
/// as the surfaces are. `surface_of` is called once per tile, in order. `points` is about the
/// number of points of the model. Cost: O(faces) time and memory for the mesh, and O(faces at
/// seams) more.
JoinedSurface join_tiles(std::size_t tiles, std::size_t points,
                         const std::function<TileSurface(std::size_t tile)>& surface_of,
                         int max_hole);

} // namespace vcarve
