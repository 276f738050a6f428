#include "mesh/collapse_edges.h"

#include "mesh/vertices.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {

TriMesh collapse_edges(const TriMesh& mesh, const CollapseLimits& limits)
{
    if (mesh.faces.empty()) return mesh;
    const Eigen::Vector3d center = box_center(mesh);
    std::vector<Eigen::Vector3f> positions(mesh.positions.size());
    std::ranges::transform(mesh.positions, positions.begin(), [&](const Eigen::Vector3d& position) {
        return Eigen::Vector3f((position - center).cast<float>());
    });
    const float* const coordinates = positions[0].data();
    const float extent =
        meshopt_simplifyScale(coordinates, positions.size(), sizeof(Eigen::Vector3f));
    const auto max_error =
        static_cast<float>(std::min(limits.max_distance / static_cast<double>(extent), 1e30));
    std::vector<Face> faces(mesh.faces.size());
    const std::size_t num_corners = meshopt_simplify(
        faces[0].data(), mesh.faces[0].data(), 3 * mesh.faces.size(), coordinates, positions.size(),
        sizeof(Eigen::Vector3f), 3 * limits.min_faces, max_error,
        limits.locks_boundary ? static_cast<unsigned>(meshopt_SimplifyLockBorder) : 0U, nullptr);
    faces.resize(num_corners / 3);
    return with_used_vertices(mesh, std::move(faces));
}

} // namespace vcarve
