#include "tiles/measure_usual_values.h"

#include "base/statistics.h"
#include "mesh/half_edge_mesh.h"
#include "pipeline/stages.h"
#include "steps/3_cells/limits.h"
#include "tiles/tile_state.h"
#include "tiles/tiling.h"

#include <algorithm>
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

/// At most `most` windows of neighboring points of a scene, evenly chosen.
std::vector<std::vector<std::uint32_t>> windows_of(const Scene& scene, std::size_t most)
{
    constexpr std::size_t kWindow = 8'000;
    const Tiling tiling = divide(scene.positions, kWindow);
    std::vector<std::vector<std::uint32_t>> all = points_by_tile(tiling, scene.positions);
    const std::size_t count = std::min(all.size(), most);
    std::vector<std::vector<std::uint32_t>> windows;
    for (std::size_t i = 0; i < count; ++i) {
        windows.push_back(std::move(all[i * all.size() / count]));
    }
    return windows;
}

} // namespace

UsualValues measure_usual_values(std::size_t tiles,
                                 const std::function<Scene(std::size_t tile)>& points_of,
                                 const Options& options, const Log& log)
{
    constexpr std::size_t kWindows = 8;
    const std::size_t count = std::min(tiles, kWindows);
    std::vector<UsualValues> measured;
    for (std::size_t i = 0; i < count; ++i) {
        const Scene scene = points_of(i * tiles / count);
        for (const auto& window : windows_of(scene, (kWindows + count - 1) / count)) {
            measured.push_back(measured_in(selected(scene, window), options, log));
        }
    }
    UsualValues usual;
    for (const auto which : kUsualValues) {
        std::vector<double> values;
        for (const UsualValues& each : measured) {
            if (each.*which) values.push_back(*(each.*which));
        }
        if (!values.empty()) usual.*which = median_in_place(values);
    }
    return usual;
}

} // namespace vcarve
