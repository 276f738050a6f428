#include "surface/extract.h"

namespace vcarve {

namespace {

std::vector<Face> boundary_faces(const TetMesh& mesh, const Labels& labels)
{
    std::vector<Face> faces;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        if (labels[i] == Label::outside) {
            continue;
        }
        const Cell& cell = mesh.cells[i];
        for (int slot = 0; slot < 4; ++slot) {
            if (labels[cell.neighbors[slot]] == Label::outside) {
                const auto& [a, b, c] = kFacetCorners[slot]; // counter-clockwise from inside
                faces.push_back({cell.vertices[a], cell.vertices[c], cell.vertices[b]});
            }
        }
    }
    return faces;
}

} // namespace

TriMesh extract_surface(const TetMesh& cells, const Labels& labels, const Scene& scene)
{
    TriMesh mesh;
    mesh.offset = scene.offset;
    mesh.faces = boundary_faces(cells, labels);
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

} // namespace vcarve
