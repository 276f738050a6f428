#pragma once

#include "cli/console_log.h"
#include "vcarve/options.h"

#include <cstdint>
#include <optional>
#include <string>

namespace vcarve::cli {

/// What is known of a surface when a run is over.
struct RunOutcome {
    std::string out; ///< where it was written
    std::int64_t faces = 0;
    std::int64_t boundary_edges = 0;
    std::optional<double> open; ///< share of what the views look at (measure_openness)
    double long_area = 0.0;     ///< share of the area in faces with an edge over kLong median edges
    std::int64_t points = 0;    ///< that the surface was made of
    std::int64_t points_before = 0; ///< that the filter was given
    std::int64_t few_views = 0;     ///< of these, dropped by --min-views
    std::int64_t high_error = 0;    ///< ... by --max-error
    std::int64_t low_angle = 0;     ///< ... by --min-angle
    std::int64_t stray = 0;         ///< ... by --stray-spacing
    bool is_dense = false;
    bool has_report = false;
    static constexpr double kLong = 10.0;
};

/// Fills in what the stages of a run counted.
RunOutcome outcome_of(const CountsOfStages& counts);

/// What was made: "wrote out.ply: 22,268 faces, 4 % of what cameras see is open (to close:
/// --max-closing 0)", and in lines of their own at most two things to try, of those that the
/// figures and the options give reason for; if there is none, how to look at the surface.
std::string closing_line(const RunOutcome& outcome, const Options& options);

} // namespace vcarve::cli
