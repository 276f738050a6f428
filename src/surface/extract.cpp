#include "surface/extract.h"

#include "base/index_limit.h"
#include "base/parallel.h"
#include "surface/used_vertices.h"

#include <algorithm>
#include <utility>

namespace vcarve {

std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<CellFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
        if (labels[cell] == Label::outside) {
            return;
        }
        for (int slot = 0; slot < 4; ++slot) {
            if (labels[cells.cells[cell].neighbors[slot]] == Label::outside) {
                facets.push_back({static_cast<Index>(cell), slot});
            }
        }
    });
}

std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets)
{
    const auto key = [](const CellFacet& f) { return std::pair(f.cell, f.slot); };
    const auto found = std::ranges::lower_bound(facets, key(facet), {}, key);
    return static_cast<std::size_t>(found - facets.begin());
}

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets)
{
    require_indexable(facets.size(), kMostFaces, "faces");
    std::vector<Face> faces(facets.size());
    parallel_for(faces.size(), [&](std::size_t i) {
        const auto& corners = cells.cells[facets[i].cell].vertices;
        const auto& [a, b, c] = kFacetCorners[facets[i].slot]; // counter-clockwise from inside
        faces[i] = {corners[a], corners[c], corners[b]};
    });
    return faces;
}

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
    mesh.colors.resize(mesh.points.size());
    parallel_for(mesh.points.size(), [&](std::size_t vertex) {
        mesh.positions[vertex] = cells.positions[mesh.points[vertex]];
        mesh.colors[vertex] = scene.colors[mesh.points[vertex]];
    });
    renumber(mesh.faces, mesh.points, cells.positions.size());
    return mesh;
}

} // namespace vcarve
