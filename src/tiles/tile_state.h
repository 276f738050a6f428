#pragma once

#include "model/scene_check.h"
#include "model/scene_points.h"
#include "pipeline/run_state.h"
#include "vcarve/log.h"
#include "vcarve/options.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace vcarve {

/// Passes on only whether to stop.
class QuietLog final : public Log {
  public:
    explicit QuietLog(const Log& log) : log_(log) {}
    bool should_stop() const override { return log_.should_stop(); }

  private:
    const Log& log_;
};

inline RunSize size_of_tile(const Scene& scene, const Options& options)
{
    RunSize size = {
        .read = size_of(scene), .thinned = size_of(scene), .options = options, .is_tile = true};
    size.options.refine.simplify.faces = 0; // done for the faces that the tile owns
    return size;
}

/// The state of a run over a tile, whose stages are not shown.
struct TileState {
    TileState(Scene scene, const Options& options, const UsualValues& usual, const Log& log)
        : quiet(log),
          state{.size = size_of_tile(scene, options),
                .log = quiet,
                .usual = usual,
                .points = {std::move(scene), {}}}
    {
    }

    QuietLog quiet;
    RunState state;
};

/// The numbers of points of a scene, for which keeps(point) is true.
template <typename Keeps>
std::vector<std::uint32_t> points_with(const Scene& scene, const Keeps& keeps)
{
    return parallel_collect<std::uint32_t>(scene.num_points(), [&](std::size_t i, auto& found) {
        if (keeps(i)) found.push_back(static_cast<std::uint32_t>(i));
    });
}

inline Scene selected(const Scene& scene, const std::vector<std::uint32_t>& points)
{
    return select_points(scene, points, [&](std::size_t i) { return scene.tracks[points[i]]; });
}

} // namespace vcarve
