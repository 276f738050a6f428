#include "page/display_mesh.h"

#include "mesh/vertices.h"
#include "model/scene_points.h"

#include <Eigen/Geometry>
#include <meshoptimizer.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// The vertices that the faces use, in their order, and what belongs to them.
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

/// At most so many of the faces, evenly chosen.
std::vector<Face> some_faces(const std::vector<Face>& faces, std::size_t max_faces)
{
    std::vector<Face> chosen(std::min(faces.size(), max_faces));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        chosen[i] = faces[i * faces.size() / chosen.size()];
    }
    return chosen;
}

/// Rims stay: without them small pieces would vanish, here all and there none.
std::vector<Face> collapse_edges(const TriMesh& mesh, std::size_t max_faces)
{
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& position : mesh.positions) {
        box.extend(position);
    }
    std::vector<Eigen::Vector3f> positions(mesh.positions.size());
    std::ranges::transform(mesh.positions, positions.begin(), [&](const Eigen::Vector3d& position) {
        return Eigen::Vector3f((position - box.center()).cast<float>());
    });
    std::vector<Face> faces(mesh.faces.size());
    const std::size_t num_corners = meshopt_simplify(
        faces[0].data(), mesh.faces[0].data(), 3 * mesh.faces.size(), positions[0].data(),
        positions.size(), sizeof(Eigen::Vector3f), 3 * max_faces, std::numeric_limits<float>::max(),
        meshopt_SimplifyLockBorder, nullptr);
    faces.resize(num_corners / 3);
    return faces;
}

} // namespace

TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress)
{
    const auto wanted = static_cast<std::size_t>(std::max<std::int64_t>(max_faces, 1));
    if (mesh.faces.size() <= wanted) return mesh;
    std::vector<Face> faces = collapse_edges(mesh, wanted);
    progress.tell(1.0);
    if (faces.size() > wanted) faces = some_faces(faces, wanted);
    return with_used_vertices(mesh, std::move(faces));
}

} // namespace vcarve
