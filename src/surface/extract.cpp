#include "surface/extract.h"

#include "base/index_limit.h"

namespace vcarve {

namespace {

/// Calls visit(cell, slot) for every facet by which an inside cell meets an outside one.
template <typename Visit>
void for_each_boundary_facet(const TetMesh& mesh, const Labels& labels, const Visit& visit)
{
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (labels[cell] == Label::outside) {
            continue;
        }
        for (int slot = 0; slot < 4; ++slot) {
            if (labels[mesh.cells[cell].neighbors[slot]] == Label::outside) {
                visit(cell, slot);
            }
        }
    }
}

std::vector<Face> boundary_faces(const TetMesh& mesh, const Labels& labels)
{
    std::vector<Face> faces;
    for_each_boundary_facet(mesh, labels, [&](Index cell, int slot) {
        const auto& corners = mesh.cells[cell].vertices;
        const auto& [a, b, c] = kFacetCorners[slot]; // counter-clockwise from inside
        faces.push_back({corners[a], corners[c], corners[b]});
    });
    return faces;
}

} // namespace

TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene)
{
    TriMesh mesh;
    mesh.offset = scene.offset;
    mesh.faces = boundary_faces(cells, labels);
    require_indexable(mesh.faces.size(), kMostFaces, "faces");
    std::vector<std::uint32_t> new_index(cells.positions.size(), kNoPoint);
    for (const Face& face : mesh.faces) {
        for (const std::uint32_t vertex : face) {
            new_index[vertex] = 0;
        }
    }
    for (std::uint32_t point = 0; point < new_index.size(); ++point) {
        if (new_index[point] == kNoPoint) {
            continue;
        }
        new_index[point] = static_cast<std::uint32_t>(mesh.positions.size());
        mesh.positions.push_back(cells.positions[point]);
        mesh.colors.push_back(scene.colors[point]);
        mesh.points.push_back(point);
    }
    for (Face& face : mesh.faces) {
        for (std::uint32_t& vertex : face) {
            vertex = new_index[vertex];
        }
    }
    return mesh;
}

std::vector<Index> cells_behind(const TetMesh& cells, const Labels& labels)
{
    std::vector<Index> behind;
    for_each_boundary_facet(cells, labels, [&](Index cell, int) { behind.push_back(cell); });
    return behind;
}

} // namespace vcarve
