#include "tiles/tile_runs.h"

#include "base/numbers.h"
#include "pipeline/stages.h"
#include "steps/1_points/arrange.h"
#include "steps/3_cells/limits.h"
#include "steps/6_surface/cleanup.h"
#include "tiles/tile_state.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// Sorts points, and drops those at the position of another: neighboring tiles may have moved
/// points to the same position.
Scene sorted_and_distinct(Scene scene)
{
    scene = spatial_sort(std::move(scene));
    const auto& positions = scene.positions;
    if (std::ranges::adjacent_find(positions) == positions.end()) return scene;
    return selected(scene, points_with(scene, [&](std::size_t i) {
                        return i == 0 || positions[i] != positions[i - 1];
                    }));
}

} // namespace

Scene tile_points(std::size_t tile, Scene around, std::size_t own, const TileRun& run)
{
    std::vector<std::uint64_t> own_ids(around.point_ids.begin(),
                                       around.point_ids.begin() + static_cast<std::ptrdiff_t>(own));
    std::ranges::sort(own_ids);
    TileState tiled(std::move(around), run.options, run.usual, run.log);
    Scene& scene = tiled.state.points.scene;
    try {
        run_stages(Part::points, tiled.state);
    } catch (const NoSurface&) { // too few points
        return without_points(scene);
    }
    Scene made = selected(scene, points_with(scene, [&](std::size_t i) {
                              return scene.kind_of(i) == PointKind::measured
                                         ? std::ranges::binary_search(own_ids, scene.point_ids[i])
                                         : run.tiling.tile_of(scene.positions[i]) == tile;
                          }));
    for (std::size_t i = 0; i < made.num_points(); ++i) {
        made.point_ids[i] = tile_point(tile, i);
    }
    return made;
}

Scene witnesses_of(const Scene& points, std::size_t one_in)
{
    Scene witnesses = selected(points, points_with(points, [&](std::size_t i) {
                                   return mix(points.point_ids[i]) % one_in == 0;
                               }));
    witnesses.kinds.assign(witnesses.num_points(), PointKind::witness);
    return witnesses;
}

TileSurface tile_surface(std::size_t tile, Scene around, const TileRun& run)
{
    constexpr double kSmall = 4.0; // squared spacings per face of min_component, as in one piece
    TileState tiled(sorted_and_distinct(std::move(around)), run.options, run.usual, run.log);
    RunState& state = tiled.state;
    const Scene& scene = state.points.scene;
    try {
        for (const Part part : {Part::cells, Part::rays, Part::surface}) {
            run_stages(part, state);
        }
    } catch (const NoSurface&) {
        return {};
    }
    state.cells = {};
    run_stages(Part::refinement, state);
    const bool simplifies =
        scene.is_dense && run.options.refine.simplify.faces == SimplifyOptions::kAutoFaces;
    const double spacing = run.usual.vertex_spacing.value_or(0.0);
    if (simplifies) {
        drop_small_components(state.surface, kSmall * spacing * spacing *
                                                 run.options.surface.cleanup.min_component);
    }
    return owned_faces(tile, run.tiling, std::move(state.surface), scene.point_ids,
                       {simplifies, spacing});
}

} // namespace vcarve
