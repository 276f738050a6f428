#pragma once

#include "base/options.h"
#include "model/scene.h"

#include <cstdint>

namespace vcarve {

/// Which points are good enough to carve with.
struct FilterOptions {
    int min_views = 2;
    double max_error_px = 4.0;
    double min_angle_deg = 1.0;

    void visit(OptionVisitor& options)
    {
        options.stage("Points");
        options.count(min_views, {.name = "min-views",
                                  .unit = "views",
                                  .help = "Drop points seen by fewer views.",
                                  .min = 1});
        options.number(
            max_error_px,
            {.name = "max-error",
             .unit = "px",
             .help = "Drop points whose mean reprojection error is larger; 0 keeps all."});
        options.number(
            min_angle_deg,
            {.name = "min-angle",
             .unit = "deg",
             .help = "Drop points whose sights all meet at a smaller angle; 0 keeps all.",
             .max = 180.0});
    }
};

/// How many points were dropped, and why; each dropped point counts once, for the first reason.
struct FilterReport {
    std::int64_t non_finite = 0; ///< a coordinate is not a finite number
    std::int64_t duplicate = 0;  ///< merged into another point at the same place
    std::int64_t few_views = 0;
    std::int64_t high_error = 0;
    std::int64_t low_angle = 0;
};

struct FilteredPoints {
    Scene scene;
    FilterReport report;
};

/// The points fit for a triangulation: finite, no two at one place, each seen well enough. Points
/// at one place become one, with the views of all, and what else belongs to the best of them (most
/// views, then smallest error, then smallest id). The order of the points is that of the input.
/// Cost: O(points log points + sights), in parallel.
FilteredPoints filter_points(const Scene& scene, const FilterOptions& options);

} // namespace vcarve
