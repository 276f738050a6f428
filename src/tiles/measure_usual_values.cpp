#include "tiles/measure_usual_values.h"

#include "base/statistics.h"
#include "mesh/half_edge_mesh.h"
#include "model/extent.h"
#include "pipeline/stages.h"
#include "steps/3_cells/limits.h"
#include "tiles/tile_state.h"
#include "tiles/tiling.h"

#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// The usual values of a few points. Some stay unknown if the points have no surface.
UsualValues measured_in(Scene window, const Options& options, const Log& log)
{
    TileState tile(std::move(window), options, {}, log);
    RunState& state = tile.state;
    try {
        for (const Part part :
             {Part::points, Part::cells, Part::rays, Part::surface, Part::refinement}) {
            run_stages(part, state);
        }
    } catch (const NoSurface&) {
        return state.usual;
    }
    std::vector<double> spacings = vertex_spacings(*state.mesh);
    std::erase(spacings, 0.0);
    state.usual.vertex_spacing = median_in_place(spacings);
    return state.usual;
}

/// The points of every few windows of neighboring points.
std::vector<std::vector<std::uint32_t>> windows_of(const Scene& scene)
{
    constexpr std::size_t kWindow = 8'000;
    constexpr std::size_t kMost = 8;
    const Tiling tiling = divide(scene.positions, kWindow);
    const std::size_t step = 1 + (tiling.size() - 1) / kMost;
    std::vector<std::vector<std::uint32_t>> all = points_by_tile(tiling, scene.positions);
    std::vector<std::vector<std::uint32_t>> windows;
    for (std::size_t window = 0; window < all.size(); window += step) {
        windows.push_back(std::move(all[window]));
    }
    return windows;
}

} // namespace

UsualValues measure_usual_values(const Scene& scene, const Options& options, const Log& log)
{
    std::vector<UsualValues> measured;
    for (const std::vector<std::uint32_t>& window : windows_of(scene)) {
        measured.push_back(measured_in(selected(scene, window), options, log));
    }
    UsualValues usual;
    for (const auto which : kUsualValues) {
        std::vector<double> values;
        for (const UsualValues& each : measured) {
            if (each.*which) values.push_back(*(each.*which));
        }
        if (!values.empty()) usual.*which = median_in_place(values);
    }
    usual.radius = region_of_interest(scene).radius;
    return usual;
}

} // namespace vcarve
