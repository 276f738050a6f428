#include "cli/mesh_report.h"

#include "io/files/output_file.h"
#include "page/page.h"
#include "page/page_scene.h"
#include "steps/4_visibility/face_visibility.h"

#include <utility>

namespace vcarve::cli {

ReportParts make_report(const TriMesh& mesh, const Texture& texture, const RemovedFaces& removed,
                        const Scene& scene, Log& log)
{
    Stage stage(log, "report");
    ReportParts parts;
    parts.figures = surface_figures(mesh, face_supports(mesh, scene), scene);
    parts.scene = packed_scene(scene);
    Json surface = packed_surface(mesh, scene, {}, stage);
    const auto shown = surface["faces"]["count"].get<std::int64_t>();
    // A surface that is simplified for the page has other corners than its texture.
    if (shown == parts.figures.faces) surface["texture"] = packed_texture(texture);
    parts.scene["surfaces"] = {std::move(surface)};
    parts.scene["removed"] = packed_removed(removed);
    stage.end({{"faces shown", shown}, {"of", parts.figures.faces}});
    return parts;
}

Json report_json(const ReportParts& parts, const Json& record)
{
    Json json = figures_json(parts.figures);
    json["warnings"] = warnings_of(parts.figures, record);
    return json;
}

void write_report(const std::filesystem::path& path, const Json& record, const ReportParts& parts)
{
    OutputFile file(path);
    write_page(file.stream(), record, parts.scene);
    file.commit();
}

} // namespace vcarve::cli
