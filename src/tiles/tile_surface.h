#pragma once

#include "run/stage_file.h"
#include "tiles/tiling.h"
#include "vcarve/options.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// The name of a vertex, which is the same in all tiles around it: the number of its point
/// (tile_point()), or the bits of its position if it is no point; and the number of the copy if it
/// was split.
struct VertexName {
    std::array<std::uint64_t, 3> point{};
    std::uint64_t copy = 0;

    bool operator<(const VertexName& other) const
    {
        return point != other.point ? point < other.point : copy < other.copy;
    }
};

/// The faces that a tile owns: those whose point with the least number is in the tile.
struct TileSurface {
    TriMesh mesh;                                         ///< with normals
    std::vector<std::uint32_t> shared;                    ///< vertices of faces of other tiles, too
    std::vector<VertexName> names;                        ///< of these
    std::vector<std::array<std::uint32_t, 2>> seam_edges; ///< whose other face another tile owns
    std::int64_t boundary_edges = 0;                      ///< not between shared vertices
};

template <>
inline constexpr int kNumFields<TileSurface> = 5;

/// The number of a point of a tile among all tiles.
constexpr std::uint64_t tile_point(std::size_t tile, std::size_t point)
{
    return (std::uint64_t{tile} << 32U) | point;
}

/// Whether and how far the faces of a cloud are simplified.
struct TileSimplification {
    bool is_wanted = false;
    double spacing = 0.0; ///< of the vertices of the whole surface, in scene units
};

/// Returns the faces of `mesh` that a tile owns. `mesh` is the surface in the tile and around it,
/// with TriMesh::points and normals; `point_ids` are tile_point() of the points. Simplifies the
/// faces as a run in one piece does, except along seams. Cost: O(faces log faces).
TileSurface owned_faces(std::size_t tile, const Tiling& tiling, TriMesh mesh,
                        const std::vector<std::uint64_t>& point_ids,
                        const TileSimplification& simplification);

} // namespace vcarve
