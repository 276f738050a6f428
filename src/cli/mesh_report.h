#pragma once

#include "base/progress.h"
#include "cli/console_log.h"
#include "cli/run_record.h"
#include "mesh/check.h"
#include "model/photograph.h"
#include "page/run_figures.h"
#include "steps/6_surface/carve_surface.h"
#include "stereo/depth_picture.h"
#include "vcarve/options.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace vcarve::cli {

/// What --report needs beside the record of a run.
struct ReportParts {
    SurfaceFigures figures;
    Json scene; ///< what the page draws
};

/// What a report shows.
struct ReportSubject {
    const TriMesh& mesh;
    const Texture& texture; ///< may be empty
    const RemovedFaces& removed;
    const Scene& scene;
    const DepthPicture& depth; ///< may be empty
};

/// Measures and packs what a report shows, as the stage "report".
ReportParts make_report(const ReportSubject& shown, Log& log);

/// The record of a report: figures, and warnings.
Json report_json(const ReportParts& parts, const Json& record);

/// Writes the page. Throws UsageError where it cannot be written.
void write_report(const std::filesystem::path& path, const Json& record, const ReportParts& parts);

/// Checks a surface, as the stage "check", and returns its record. The number of rays from behind
/// is taken from the counts of the stages before.
Json checked(const TriMesh& mesh, const CountsOfStages& counts, Log& log);

/// Throws std::logic_error with the command and the model if a surface is not manifold, not
/// oriented or has a degenerate face. Boundary edges, self-intersections and rays from behind are
/// only counted.
void require_promised(const Json& surface, const std::string& command, const std::string& model);

/// What is known of a surface when a run is over.
struct RunOutcome {
    std::string out; ///< where it was written
    std::int64_t faces = 0;
    std::int64_t boundary_edges = 0;
    std::optional<double> open; ///< share of what the views look at (measure_openness)
    double past = 0.0;          ///< share of their pixels that meet no surface, open or not
    double long_area = 0.0;     ///< share of the area in faces with an edge over kLong median edges
    std::int64_t points = 0;    ///< that the surface was made of
    std::int64_t points_before = 0; ///< that the filter was given
    std::int64_t few_views = 0;     ///< of these, dropped by --min-views
    std::int64_t high_error = 0;    ///< ... by --max-error
    std::int64_t low_angle = 0;     ///< ... by --min-angle
    std::int64_t stray = 0;         ///< ... by --stray-spacing
    bool is_dense = false;
    bool takes_nearest_views = false; ///< see FoundInput
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
