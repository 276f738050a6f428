#pragma once

#include "base/progress.h"
#include "cli/run_record.h"
#include "model/photograph.h"
#include "page/run_figures.h"
#include "steps/6_surface/carve_surface.h"

#include <filesystem>

namespace vcarve::cli {

/// What --report needs of a run beside its record.
struct ReportParts {
    SurfaceFigures figures;
    Json scene; ///< what the page draws
};

/// Measures and packs a surface, its texture, what was taken away from it and the scene it was made
/// from, as the stage "report".
ReportParts make_report(const TriMesh& mesh, const Texture& texture, const RemovedFaces& removed,
                        const Scene& scene, Log& log);

/// What a record says of a report: figures, and warnings made of them and of the record's stages.
Json report_json(const ReportParts& parts, const Json& record);

/// Writes the page. Throws UsageError where it cannot be written.
void write_report(const std::filesystem::path& path, const Json& record, const ReportParts& parts);

} // namespace vcarve::cli
