#include "mesh/half_edge_mesh.h"

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

/// The kept faces and their vertices as arrays, in the order they have in `mesh`.
class KeptSurface {
  public:
    KeptSurface(const HalfEdgeMesh& mesh, const std::vector<char>& keep_faces)
        : mesh_(mesh), keep_faces_(keep_faces)
    {
    }

    TriMesh collect(const TriMesh& like)
    {
        number_vertices();
        for (const auto vertex : mesh_.vertices()) {
            if (numbers_[index(vertex)] != kDropped) add_vertex(vertex, like);
        }
        for (const auto face : mesh_.faces()) {
            if (keep_faces_[index(face)] != 0) add_face(face);
        }
        result_.offset = like.offset;
        return std::move(result_);
    }

  private:
    static constexpr std::uint32_t kDropped = 0xffffffffU;

    /// Vertices of kept faces are numbered in ascending order.
    void number_vertices()
    {
        numbers_.assign(mesh_.n_vertices(), kDropped);
        for (const auto face : mesh_.faces()) {
            if (keep_faces_[index(face)] == 0) continue;
            for (const auto vertex : mesh_.fv_range(face)) {
                numbers_[index(vertex)] = 0;
            }
        }
        std::uint32_t next = 0;
        for (std::uint32_t& number : numbers_) {
            if (number != kDropped) number = next++;
        }
    }

    /// The optional arrays are there if `like` has them; normals always are.
    void add_vertex(OpenMesh::VertexHandle vertex, const TriMesh& like)
    {
        const OpenMesh::Vec3d& p = mesh_.point(vertex);
        const OpenMesh::Vec3d n = vertex_normal(mesh_, vertex);
        result_.positions.emplace_back(p[0], p[1], p[2]);
        result_.normals.push_back(Eigen::Vector3d(n[0], n[1], n[2]).cast<float>());
        if (!like.colors.empty()) result_.colors.push_back(mesh_.data(vertex).color);
        if (!like.points.empty()) result_.points.push_back(mesh_.data(vertex).point);
    }

    void add_face(OpenMesh::FaceHandle face)
    {
        Face corners{};
        std::size_t i = 0;
        for (const auto vertex : mesh_.fv_range(face)) {
            corners[i++] = numbers_[index(vertex)];
        }
        result_.faces.push_back(corners);
    }

    const HalfEdgeMesh& mesh_;
    const std::vector<char>& keep_faces_;
    std::vector<std::uint32_t> numbers_;
    TriMesh result_;
};

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

TriMesh kept_surface(const HalfEdgeMesh& mesh, const std::vector<char>& keep_faces,
                     const TriMesh& like)
{
    return KeptSurface(mesh, keep_faces).collect(like);
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
