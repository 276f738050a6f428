#include "cli/mesh_report.h"

#include "io/files/output_file.h"
#include "mesh/self_intersections.h"
#include "page/page.h"
#include "page/page_scene.h"
#include "steps/4_visibility/seen_corners.h"

#include <fmt/format.h>

#include <stdexcept>

namespace vcarve::cli {

namespace {

Json check_json(const MeshCheck& check)
{
    return {{"vertices", check.vertices},
            {"faces", check.faces},
            {"degenerate_faces", check.degenerate_faces},
            {"components", check.components},
            {"boundary_edges", check.boundary_edges},
            {"nonmanifold_edges", check.nonmanifold_edges},
            {"nonmanifold_vertices", check.nonmanifold_vertices},
            {"orientation_faults", check.orientation_faults},
            {"unreferenced_vertices", check.unreferenced_vertices},
            {"euler_characteristic", check.euler_characteristic},
            {"area", check.area},
            {"is_closed", check.is_closed()},
            {"is_manifold", check.is_manifold()}};
}

} // namespace

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

Json checked(const TriMesh& mesh, const CountsOfStages& counts, Log& log)
{
    Stage stage(log, "check");
    Json json = check_json(check_mesh(mesh));
    json["self_intersections"] = count_self_intersections(mesh);
    Counts told;
    const auto oriented = counts.find("orient");
    if (oriented != counts.end() && oriented->second.size() > 1) {
        const std::int64_t sights = oriented->second[1].second;
        told = {{"sights from behind", sights - oriented->second[0].second}, {"of", sights}};
    }
    told.emplace_back("open edges", json["boundary_edges"]);
    told.emplace_back("self-intersections", json["self_intersections"]);
    stage.end(told);
    return json;
}

void require_promised(const Json& surface, const std::string& command, const std::string& model)
{
    for (const char* const fault :
         {"nonmanifold_edges", "nonmanifold_vertices", "orientation_faults", "degenerate_faces"}) {
        if (surface[fault] == 0) continue;
        throw std::logic_error(fmt::format("the surface has {} {} and was not written; {} "
                                           "reproduces it with {}",
                                           surface[fault].dump(), fault, command, model));
    }
}

} // namespace vcarve::cli
