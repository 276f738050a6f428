#include "cli/mesh_report.h"

#include "io/files/output_file.h"
#include "page/page.h"
#include "page/page_scene.h"
#include "steps/4_visibility/face_visibility.h"

namespace vcarve::cli {

ReportParts make_report(const TriMesh& mesh, const Texture& texture, const RemovedFaces& removed,
                        const Scene& scene, Log& log)
{
    Stage stage(log, "report");
    ReportParts parts;
    parts.figures = surface_figures(mesh, face_supports(mesh, scene), scene);
    parts.scene = packed_scene(scene);
    parts.scene["surface"] = packed_surface(mesh, scene, {}, stage);
    // A surface that is simplified for the page has other corners than its texture.
    const bool is_whole = parts.scene["surface"]["faces"]["count"] == mesh.faces.size();
    parts.scene["surface"]["texture"] = is_whole ? packed_texture(texture) : Json(nullptr);
    parts.scene["removed"] = packed_removed(removed);
    stage.end({{"faces shown", parts.scene["surface"]["faces"]["count"].get<std::int64_t>()},
               {"of", parts.figures.faces}});
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
