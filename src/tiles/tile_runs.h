#pragma once

#include "model/usual_values.h"
#include "tiles/tile_surface.h"
#include "tiles/tiling.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve {

/// What all tiles of a run share.
struct TileRun {
    const Tiling& tiling;
    const Options& options;
    const UsualValues& usual; ///< of the whole model
    const Log& log;           ///< only asked whether to stop
};

/// Filters, denoises and completes the points of a tile. `around` has the points of the tile and of
/// its margin as they were read; the first `own` of them are those of the tile. Returns the points
/// of the tile only, also none, with tile_point() as their ids. Throws the exceptions of the
/// stages, but not if the points are too few for a surface.
Scene tile_points(std::size_t tile, Scene around, std::size_t own, const TileRun& run);

/// One in `one_in` points, as witnesses of free space in other tiles.
Scene witnesses_of(const Scene& points, std::size_t one_in);

/// Makes the surface of a tile. `around` has the points of the tile, of its margin, and witnesses
/// outside of it; Scene::point_ids are tile_point(). The surface has no faces if the points have
/// none. Throws the exceptions of the stages.
TileSurface tile_surface(std::size_t tile, Scene around, const TileRun& run);

} // namespace vcarve
