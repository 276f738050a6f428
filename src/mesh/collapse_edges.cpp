#include "mesh/collapse_edges.h"

#include "base/parallel.h"
#include "mesh/vertices.h"
#include "model/scene_points.h"

#include <Eigen/Core>
#include <meshoptimizer.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3f;

std::vector<Face> collapsed(std::span<const Face> faces, const std::vector<Vector3f>& positions,
                            const CollapseLimits& limits)
{
    std::vector<Face> local(faces.begin(), faces.end());
    const std::vector<std::uint32_t> used = used_vertices(local, positions.size());
    renumber(local, used, positions.size());
    const std::vector<Vector3f> places = values_at(used, positions);
    const float* const coordinates = places[0].data();
    const float extent = meshopt_simplifyScale(coordinates, places.size(), sizeof(Vector3f));
    const auto max_error =
        static_cast<float>(std::min(limits.max_distance / static_cast<double>(extent), 1e30));
    std::vector<Face> left(local.size());
    const std::size_t num_corners = meshopt_simplify(
        left[0].data(), local[0].data(), 3 * local.size(), coordinates, places.size(),
        sizeof(Vector3f), 3 * limits.min_faces, max_error,
        limits.locks_boundary ? static_cast<unsigned>(meshopt_SimplifyLockBorder) : 0U, nullptr);
    left.resize(num_corners / 3);
    for (Face& face : left) {
        for (std::uint32_t& v : face)
            v = used[v];
    }
    return left;
}

/// The faces after collapses within runs of faces, in parallel, to half of the distance. Faces of a
/// run are mostly neighbors.
std::vector<Face> collapsed_in_parts(std::vector<Face> faces,
                                     const std::vector<Vector3f>& positions,
                                     const CollapseLimits& limits)
{
    constexpr std::size_t kPart = 100'000;
    const std::size_t num_parts = faces.size() / kPart;
    if (num_parts < 2) return faces;
    const auto collapse = [&](std::size_t part, std::vector<Face>& left) {
        const std::size_t first = part * faces.size() / num_parts;
        const std::size_t last = (part + 1) * faces.size() / num_parts;
        std::ranges::copy(
            collapsed(std::span(faces).subspan(first, last - first), positions,
                      {.max_distance = 0.5 * limits.max_distance, .locks_boundary = true}),
            std::back_inserter(left));
    };
    return parallel_collect<Face>(num_parts, collapse, 1);
}

} // namespace

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
    std::vector<Vector3f> positions(mesh.positions.size());
    std::ranges::transform(mesh.positions, positions.begin(), [&](const Eigen::Vector3d& position) {
        return Vector3f((position - center).cast<float>());
    });
    std::vector<Face> faces = mesh.faces;
    if (limits.min_faces == 0) faces = collapsed_in_parts(std::move(faces), positions, limits);
    faces = collapsed(faces, positions, limits);
    remove_folds(faces);
    return with_used_vertices(mesh, std::move(faces));
}

} // namespace vcarve
