#include "mesh/collapse_edges.h"

#include "mesh/vertices.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace vcarve {

void remove_folds(std::vector<Face>& faces)
{
    const auto corners = [&](std::size_t face) {
        Face sorted = faces[face];
        std::ranges::sort(sorted);
        return sorted;
    };
    std::vector<std::size_t> order(faces.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::sort(order, {}, corners);
    std::vector<bool> removed(faces.size());
    for (std::size_t i = 0; i + 1 < order.size(); ++i) {
        if (corners(order[i]) != corners(order[i + 1])) continue;
        removed[order[i]] = removed[order[i + 1]] = true;
        ++i;
    }
    std::vector<Face> kept;
    for (std::size_t face = 0; face < faces.size(); ++face) {
        if (!removed[face]) kept.push_back(faces[face]);
    }
    if (!kept.empty()) faces = std::move(kept);
}

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
    remove_folds(faces);
    return with_used_vertices(mesh, std::move(faces));
}

} // namespace vcarve
