#include "mesh/check.h"

#include "base/union_find.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {
namespace {

/// What is wrong at each edge.
void count_edges(std::span<const Face> faces, const EdgeTable& edges, MeshCheck& check)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::span<const HalfEdge> half_edges = edges[e];
        if (half_edges.size() == 1) ++check.boundary_edges;
        if (half_edges.size() > 2) ++check.nonmanifold_edges;
        if (half_edges.size() == 2 && tail(faces, half_edges[0]) == tail(faces, half_edges[1])) {
            ++check.orientation_faults;
        }
    }
}

std::int64_t num_components(std::span<const Face> faces, const EdgeTable& edges)
{
    UnionFind connected(faces.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const HalfEdge half_edge : edges[e]) {
            connected.join(edges[e][0] / 3, half_edge / 3);
        }
    }
    std::int64_t count = 0;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (!is_degenerate(faces[f]) && connected.root(f) == f) ++count;
    }
    return count;
}

/// The corner of a half-edge's face at `vertex`, which is one of the half-edge's ends.
HalfEdge corner_at(std::span<const Face> faces, HalfEdge half_edge, std::uint32_t vertex)
{
    return tail(faces, half_edge) == vertex ? half_edge : next_half_edge(half_edge);
}

/// A vertex is fine if its corners hang together through edges and none of these has three faces:
/// then they form one fan or one disk.
void count_vertices(const TriMesh& mesh, const EdgeTable& edges, MeshCheck& check)
{
    const std::span<const Face> faces(mesh.faces);
    UnionFind around(3 * faces.size());
    std::vector<char> crowded(mesh.positions.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const std::uint32_t v : {tail(faces, edges[e][0]), head(faces, edges[e][0])}) {
            const HalfEdge first = corner_at(faces, edges[e][0], v);
            for (const HalfEdge half_edge : edges[e]) {
                around.join(first, corner_at(faces, half_edge, v));
            }
            if (edges[e].size() > 2) crowded[v] = 1;
        }
    }

    std::vector<std::uint32_t> fans(mesh.positions.size(), 0);
    for (HalfEdge corner = 0; corner < 3 * faces.size(); ++corner) {
        const bool counts = !is_degenerate(faces[corner / 3]) && around.root(corner) == corner;
        if (counts) ++fans[tail(faces, corner)];
    }
    for (std::size_t v = 0; v < fans.size(); ++v) {
        if (fans[v] == 0) ++check.unreferenced_vertices;
        if (fans[v] > 1 || crowded[v] != 0) ++check.nonmanifold_vertices;
    }
}

double total_area(const TriMesh& mesh)
{
    double area = 0.0;
    for (const Face& face : mesh.faces) {
        if (!is_degenerate(face)) area += face_area(mesh.positions, face);
    }
    return area;
}

} // namespace

MeshCheck check_mesh(const TriMesh& mesh)
{
    MeshCheck check;
    check.vertices = static_cast<std::int64_t>(mesh.positions.size());
    check.faces = static_cast<std::int64_t>(mesh.faces.size());
    check.degenerate_faces = std::ranges::count_if(mesh.faces, is_degenerate);

    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    count_edges(mesh.faces, edges, check);
    check.components = num_components(mesh.faces, edges);
    count_vertices(mesh, edges, check);
    check.euler_characteristic = (check.vertices - check.unreferenced_vertices) -
                                 static_cast<std::int64_t>(edges.size()) +
                                 (check.faces - check.degenerate_faces);
    check.area = total_area(mesh);
    return check;
}

} // namespace vcarve
