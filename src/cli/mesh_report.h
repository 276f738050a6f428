#pragma once

#include "base/log.h"
#include "cli/console_log.h"
#include "cli/run_record.h"
#include "mesh/check.h"
#include "mesh/removed_faces.h"
#include "model/texture.h"
#include "page/run_figures.h"

#include <filesystem>
#include <string>

namespace vcarve::cli {

/// What --report needs beside the record of a run.
struct ReportParts {
    SurfaceFigures figures;
    Json scene; ///< what the page draws
};

/// Measures and packs a surface, its texture, its removed faces and its scene, as the stage
/// "report".
ReportParts make_report(const TriMesh& mesh, const Texture& texture, const RemovedFaces& removed,
                        const Scene& scene, Log& log);

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

} // namespace vcarve::cli
