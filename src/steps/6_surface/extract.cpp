#include "steps/6_surface/extract.h"

#include "base/parallel.h"
#include "mesh/used_vertices.h"
#include "model/known_colors.h"
#include "model/scene_points.h"
#include "steps/5_labels/boundary.h"

namespace vcarve {

TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene)
{
    return extract_surface(cells, boundary_facets(cells, labels), scene);
}

TriMesh extract_surface(const TetMesh& cells, const std::vector<CellFacet>& facets,
                        const Scene& scene)
{
    TriMesh mesh;
    mesh.offset = scene.offset;
    mesh.faces = boundary_faces(cells, facets);
    mesh.points = used_vertices(mesh.faces, cells.positions.size());
    mesh.positions.resize(mesh.points.size());
    parallel_for(mesh.points.size(), [&](std::size_t vertex) {
        mesh.positions[vertex] = cells.positions[mesh.points[vertex]];
    });
    if (has_colors(scene)) mesh.colors = values_at(mesh.points, scene.colors);
    renumber(mesh.faces, mesh.points, cells.positions.size());
    return mesh;
}

} // namespace vcarve
