#include "surface/extract.h"

#include "base/index_limit.h"
#include "base/parallel.h"

#include <atomic>

namespace vcarve {

namespace {

/// The vertices that faces use, in ascending order.
std::vector<std::uint32_t> used_vertices(const std::vector<Face>& faces, std::size_t num_vertices)
{
    std::vector<char> used(num_vertices, 0);
    parallel_for(faces.size(), [&](std::size_t i) {
        for (const std::uint32_t vertex : faces[i]) {
            std::atomic_ref(used[vertex]).store(1, std::memory_order_relaxed);
        }
    });
    return parallel_collect<std::uint32_t>(num_vertices, [&](std::size_t vertex, auto& vertices) {
        if (used[vertex] != 0) vertices.push_back(static_cast<std::uint32_t>(vertex));
    });
}

} // namespace

std::vector<BoundaryFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<BoundaryFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
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

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<BoundaryFacet>& facets)
{
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
    TriMesh mesh;
    mesh.offset = scene.offset;
    mesh.faces = boundary_faces(cells, boundary_facets(cells, labels));
    require_indexable(mesh.faces.size(), kMostFaces, "faces");
    mesh.points = used_vertices(mesh.faces, cells.positions.size());
    mesh.positions.resize(mesh.points.size());
    mesh.colors.resize(mesh.points.size());
    std::vector<std::uint32_t> numbers(cells.positions.size());
    parallel_for(mesh.points.size(), [&](std::size_t vertex) {
        const std::uint32_t point = mesh.points[vertex];
        mesh.positions[vertex] = cells.positions[point];
        mesh.colors[vertex] = scene.colors[point];
        numbers[point] = static_cast<std::uint32_t>(vertex);
    });
    parallel_for(mesh.faces.size(), [&](std::size_t i) {
        for (std::uint32_t& vertex : mesh.faces[i]) {
            vertex = numbers[vertex];
        }
    });
    return mesh;
}

} // namespace vcarve
