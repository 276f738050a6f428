#include "surface/half_edge_mesh.h"

#include <stdexcept>

namespace vcarve {
namespace {

void add_vertices(const TriMesh& mesh, HalfEdgeMesh& half_edges)
{
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        const Eigen::Vector3d& p = mesh.positions[v];
        // NOLINTNEXTLINE(cppcoreguidelines-slicing): a handle is all that is wanted
        const OpenMesh::VertexHandle vertex = half_edges.add_vertex({p.x(), p.y(), p.z()});
        if (!mesh.colors.empty()) half_edges.data(vertex).color = mesh.colors[v];
        if (!mesh.points.empty()) half_edges.data(vertex).point = mesh.points[v];
    }
}

} // namespace

HalfEdgeMesh half_edge_mesh(const TriMesh& mesh)
{
    HalfEdgeMesh half_edges;
    half_edges.reserve(mesh.positions.size(), 3 * mesh.faces.size() / 2, mesh.faces.size());
    add_vertices(mesh, half_edges);
    for (const Face& face : mesh.faces) {
        const auto vertex = [&](std::size_t i) {
            return OpenMesh::VertexHandle(static_cast<int>(face[i]));
        };
        if (!half_edges.add_face(vertex(0), vertex(1), vertex(2)).is_valid()) {
            throw std::logic_error("a surface to be cleaned is not manifold");
        }
    }
    return half_edges;
}

OpenMesh::Vec3d vertex_normal(const HalfEdgeMesh& mesh, OpenMesh::VertexHandle vertex)
{
    // OpenMesh's calc_vertex_normal_correct would do, were it not wrong at borders.
    OpenMesh::Vec3d sum(0.0, 0.0, 0.0);
    for (const auto incoming : mesh.vih_range(vertex)) {
        if (mesh.is_boundary(incoming)) continue;
        OpenMesh::Vec3d twice_area;
        mesh.calc_sector_normal(incoming, twice_area);
        sum += twice_area;
    }
    return sum.sqrnorm() > 0.0 ? sum.normalized() : OpenMesh::Vec3d(0.0, 0.0, 0.0);
}

} // namespace vcarve
