#include "steps/5_surface/border_strip.h"

#include "base/parallel.h"
#include "mesh/used_vertices.h"
#include "steps/5_surface/fill_holes.h"

#include <algorithm>
#include <atomic>

namespace vcarve {
namespace {

/// Which vertices are on a border of the flagged faces.
std::vector<char> border_vertices(const TriMesh& mesh, const std::vector<Side>& mates,
                                  const std::vector<char>& keep_faces)
{
    std::vector<char> on_border(mesh.positions.size(), 0);
    const auto flag = [&](std::uint32_t vertex) {
        std::atomic_ref(on_border[vertex]).store(1, std::memory_order_relaxed);
    };
    parallel_for(mesh.faces.size(), [&](std::size_t face) {
        for (std::size_t i = 0; i < 3 && keep_faces[face] != 0; ++i) {
            if (mates[3 * face + i] != kNoSide) continue;
            flag(mesh.faces[face][i]);
            flag(mesh.faces[face][(i + 1) % 3]);
        }
    });
    return on_border;
}

/// Some vertices and faces of a surface, which have their own numbers.
TriMesh part_of(const TriMesh& mesh, const std::vector<std::uint32_t>& vertices,
                std::vector<Face> faces)
{
    TriMesh part;
    for (const std::uint32_t vertex : vertices) {
        part.positions.push_back(mesh.positions[vertex]);
        if (!mesh.colors.empty()) part.colors.push_back(mesh.colors[vertex]);
    }
    part.faces = std::move(faces);
    renumber(part.faces, vertices, mesh.positions.size());
    return part;
}

} // namespace

Collar::Collar(const TriMesh& mesh, const std::vector<Side>& mates,
               const std::vector<char>& keep_faces)
    : num_vertices_(mesh.positions.size())
{
    const std::vector<char> on_border = border_vertices(mesh, mates, keep_faces);
    std::vector<Face> faces =
        parallel_collect<Face>(mesh.faces.size(), [&](std::size_t i, auto& found) {
            const Face& face = mesh.faces[i];
            const bool touches = std::ranges::any_of(
                face, [&](std::uint32_t vertex) { return on_border[vertex] != 0; });
            if (touches && keep_faces[i] != 0) found.push_back(face);
        });
    num_faces_ = faces.size();
    vertices_ = used_vertices(faces, num_vertices_);
    for (const std::uint32_t vertex : vertices_) {
        on_border_.push_back(on_border[vertex]);
    }
    half_edges_ = half_edge_mesh(part_of(mesh, vertices_, std::move(faces)));
}

std::int64_t Collar::fill_holes(int max_edges)
{
    std::int64_t num_filled = 0;
    for (const BoundaryLoop& loop : boundary_loops(half_edges_)) {
        if (loop.size() > static_cast<std::size_t>(std::max(max_edges, 0))) continue;
        // A border of the surface has no vertex that is not on it.
        if (!on_border(half_edges_.from_vertex_handle(loop[0]))) continue;
        if (is_rim(half_edges_, loop) || touches_itself(half_edges_, loop)) continue;
        fill_hole(half_edges_, loop);
        ++num_filled;
    }
    return num_filled;
}

std::uint32_t Collar::number(OpenMesh::VertexHandle vertex) const
{
    const std::size_t own = index(vertex);
    return own < vertices_.size()
               ? vertices_[own]
               : static_cast<std::uint32_t>(num_vertices_ + own - vertices_.size());
}

void Collar::add_to(TriMesh& mesh) const
{
    for (std::size_t v = vertices_.size(); v < half_edges_.n_vertices(); ++v) {
        const OpenMesh::VertexHandle vertex(static_cast<int>(v));
        const OpenMesh::Vec3d& p = half_edges_.point(vertex);
        mesh.positions.emplace_back(p[0], p[1], p[2]);
        if (!mesh.colors.empty()) mesh.colors.push_back(half_edges_.data(vertex).color);
        if (!mesh.points.empty()) mesh.points.push_back(half_edges_.data(vertex).point);
    }
    mesh.normals.resize(mesh.positions.size());
    for (const auto vertex : half_edges_.vertices()) {
        if (!on_border(vertex)) continue;
        const OpenMesh::Vec3d n = vertex_normal(half_edges_, vertex);
        mesh.normals[number(vertex)] = Eigen::Vector3d(n[0], n[1], n[2]).cast<float>();
    }
    for (std::size_t f = num_faces_; f < half_edges_.n_faces(); ++f) {
        Face corners{};
        std::size_t i = 0;
        for (const auto vertex : half_edges_.fv_range(OpenMesh::FaceHandle(static_cast<int>(f)))) {
            corners[i++] = number(vertex);
        }
        mesh.faces.push_back(corners);
    }
}

} // namespace vcarve
