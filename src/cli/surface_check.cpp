#include "cli/surface_check.h"

#include "mesh/check.h"

#include <fmt/format.h>

#include <stdexcept>

namespace vcarve::cli {

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
        throw std::logic_error(fmt::format("the surface has {} {}, which none is to have, and was "
                                           "not written; {} repeats it with {}",
                                           surface[fault].dump(), fault, command, model));
    }
}

} // namespace vcarve::cli
