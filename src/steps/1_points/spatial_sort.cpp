#include "steps/1_points/spatial_sort.h"

#include "geometry/hilbert_order.h"
#include "model/scene_points.h"

#include <cstdint>
#include <vector>

namespace vcarve {

Scene spatial_sort(Scene scene, const Progress& progress)
{
    const std::vector<std::uint32_t> order = hilbert_order(scene.positions);
    progress.tell(0.8);
    const auto row_of = [&](std::size_t i) { return scene.tracks[order[i]]; };
    keep_points(scene, order, make_tracks(order.size(), row_of));
    return scene;
}

} // namespace vcarve
