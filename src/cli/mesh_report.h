#pragma once

#include "base/progress.h"
#include "cli/console_log.h"
#include "cli/run_record.h"
#include "mesh/check.h"
#include "page/run_figures.h"
#include "pipeline/scene_run.h"
#include "vcarve/options.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace vcarve::cli {

/// The data of --report besides the record of the run.
struct ReportParts {
    SurfaceFigures figures;
    Json scene; ///< drawn by the page
};

/// Measures and packs the data of a report, as the stage "report".
ReportParts make_report(const ReportedRun& made, Log& log);

/// The record of a report: figures, and warnings.
Json report_json(const ReportParts& parts, const Json& record);

/// Writes the page. Throws UsageError if it cannot be written.
void write_report(const std::filesystem::path& path, const Json& record, const ReportParts& parts);

/// Checks a mesh, as the stage "check", and returns the record. The number of rays from behind is
/// taken from the counts of earlier stages.
Json checked(const TriMesh& mesh, const CountsOfStages& counts, Log& log);

/// Throws std::logic_error with the command and the model if a mesh is not manifold, not oriented
/// or has a degenerate face. Boundary edges, self-intersections and rays from behind are allowed.
void require_promised(const Json& surface, const std::string& command, const std::string& model);

/// The summary of a run.
struct RunOutcome {
    std::string out; ///< the mesh file
    std::int64_t faces = 0;
    std::int64_t boundary_edges = 0;
    /// Open share of the visible surface (measure_openness).
    std::optional<double> open = std::nullopt;
    double past = 0.0;       ///< share of pixels with sky or surfaces without points
    double long_area = 0.0;  ///< share of the area in faces with an edge over kLong median edges
    std::int64_t points = 0; ///< after the filter
    std::int64_t points_before = 0; ///< before the filter
    std::int64_t few_views = 0;     ///< of these, dropped by --min-views
    std::int64_t high_error = 0;    ///< ... by --max-error
    std::int64_t low_angle = 0;     ///< ... by --min-angle
    std::int64_t stray = 0;         ///< ... by --stray-spacing
    bool is_dense = false;
    bool takes_nearest_views = false; ///< see FoundInput
    bool has_report = false;
    static constexpr double kLong = 10.0;
};

/// Completes an outcome with the counts of the stages.
RunOutcome outcome_of(const CountsOfStages& counts, RunOutcome outcome = {});

/// The number of faces without a photograph of a textured mesh.
std::int64_t bare_faces(const CountsOfStages& counts);

/// The result of a run: "wrote out.ply: 22,268 faces, holes in 4 % of the visible surface (to
/// close: --max-closing 0)". At most two proposals follow, one per line, if the figures and the
/// options give reason for them. Without proposals, it shows how to view the mesh.
std::string closing_line(const RunOutcome& outcome, const Options& options);

} // namespace vcarve::cli
