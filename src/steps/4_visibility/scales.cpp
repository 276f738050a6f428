#include "steps/4_visibility/scales.h"

#include "base/median.h"
#include "steps/4_visibility/edge_lengths.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <vector>

namespace vcarve {

namespace {

double median_views(const Tracks& tracks)
{
    std::vector<double> lengths;
    for (std::size_t point = 0; point < tracks.size(); ++point) {
        if (!tracks[point].empty()) {
            lengths.push_back(static_cast<double>(tracks[point].size()));
        }
    }
    return lengths.empty() ? 1.0 : median(lengths);
}

std::vector<double> known_errors_px(const Scene& scene)
{
    std::vector<double> errors;
    std::copy_if(scene.errors_px.begin(), scene.errors_px.end(), std::back_inserter(errors),
                 [](double error) { return error >= 0.0; });
    return errors;
}

} // namespace

Scales measure_scales(const TetMesh& cells, const Scene& scene)
{
    return {.short_edge = short_edge_length(cells),
            .median_error_px = median(known_errors_px(scene)),
            .median_views = median_views(scene.tracks)};
}

} // namespace vcarve
