#include "mesh/vertices.h"

#include "base/parallel.h"
#include "model/scene_points.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <atomic>

namespace vcarve {

VertexFaces::VertexFaces(std::span<const Face> faces, std::size_t num_vertices,
                         const FaceFlags& flags)
    : table_(gather_rows(faces.size(), num_vertices, [&](std::size_t face, const auto& visit) {
          if (!flags.empty() && flags[face] == 0) return;
          for (const std::uint32_t vertex : faces[face]) {
              visit(vertex, static_cast<std::uint32_t>(face));
          }
      }))
{
}

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

void renumber(std::vector<Face>& faces, const std::vector<std::uint32_t>& used,
              std::size_t num_vertices)
{
    std::vector<std::uint32_t> numbers(num_vertices);
    parallel_for(used.size(),
                 [&](std::size_t i) { numbers[used[i]] = static_cast<std::uint32_t>(i); });
    parallel_for(faces.size(), [&](std::size_t i) {
        for (std::uint32_t& vertex : faces[i]) {
            vertex = numbers[vertex];
        }
    });
}

std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original)
{
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Eigen::Vector3d(mesh.positions[original]));
    if (!mesh.colors.empty()) mesh.colors.push_back(Color(mesh.colors[original]));
    if (!mesh.points.empty()) mesh.points.push_back(std::uint32_t(mesh.points[original]));
    return copy;
}

std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t middle = add_copy(mesh, a);
    mesh.positions[middle] = mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) / 2;
    for (std::size_t i = 0; i < 3 && !mesh.colors.empty(); ++i) {
        mesh.colors[middle][i] =
            static_cast<std::uint8_t>((mesh.colors[a][i] + mesh.colors[b][i] + 1) / 2);
    }
    if (!mesh.points.empty()) mesh.points[middle] = kNoPoint;
    return middle;
}

Eigen::Vector3d box_center(const TriMesh& mesh)
{
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    if (mesh.positions.empty()) return Eigen::Vector3d::Zero();
    return box.center();
}

TriMesh with_used_vertices(const TriMesh& mesh, std::vector<Face> faces)
{
    const std::vector<std::uint32_t> vertices = used_vertices(faces, mesh.positions.size());
    renumber(faces, vertices, mesh.positions.size());
    TriMesh used;
    used.offset = mesh.offset;
    used.positions = values_at(vertices, mesh.positions);
    used.colors = values_at(vertices, mesh.colors);
    used.points = values_at(vertices, mesh.points);
    used.faces = std::move(faces);
    return used;
}

} // namespace vcarve
