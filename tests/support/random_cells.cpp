#include "support/random_cells.h"

#include "base/numbers.h"

#include <vector>

namespace vcarve::testing {

Scene random_points(std::size_t count, std::uint64_t seed)
{
    Scene scene;
    for (std::uint64_t i = 0; i < count; ++i) {
        scene.positions.emplace_back(random_number(seed, 3 * i), random_number(seed, 3 * i + 1),
                                     random_number(seed, 3 * i + 2));
        scene.colors.push_back({});
        scene.errors_px.push_back(0.0);
        scene.point_ids.push_back(i + 1);
        scene.tracks.push_back(std::vector<std::uint32_t>{});
    }
    return scene;
}

} // namespace vcarve::testing
