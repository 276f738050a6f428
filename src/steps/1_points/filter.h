#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// How many points were dropped, and why; each dropped point counts once, for the first reason.
struct FilterReport {
    std::int64_t non_finite = 0; ///< a coordinate is not a finite number, or beyond 1e100
    std::int64_t duplicate = 0;  ///< merged into another point at the same place
    std::int64_t few_views = 0;
    std::int64_t high_error = 0;
    std::int64_t low_angle = 0;
};

struct FilteredPoints {
    Scene scene;
    FilterReport report;
};

/// The points fit for a triangulation: finite, no two at one place, each seen well enough. A point
/// that a scanner measured is known from one view, so that neither the number of its views nor the
/// angle between its sights is asked. Points at one place, but for rounding (same_place.h), become
/// one, with the views of all, and what else belongs to the best of them (most views, then smallest
/// error, then smallest id). The order of the points is that of the input.
/// Cost: O(points log points + sights), in parallel, and 36 bytes a point beside the scene, if it
/// is moved here.
FilteredPoints filter_points(Scene scene, const FilterOptions& options,
                             const Progress& progress = {});

} // namespace vcarve
