#include "steps/4_visibility/seen_corners.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "steps/4_visibility/face_visibility.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// How many views saw the least seen corner from the front.
std::int32_t face_support(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    const Vector3d normal = face_normal(mesh.positions, face);
    const auto views_before = [&](std::uint32_t vertex) -> std::ptrdiff_t {
        if (mesh.points[vertex] == kNoPoint) {
            return 0;
        }
        const auto track = scene.tracks[mesh.points[vertex]];
        return std::count_if(track.begin(), track.end(), [&](std::uint32_t view) {
            return stands_before(scene.views[view].center, mesh.positions[vertex], normal);
        });
    };
    return static_cast<std::int32_t>(
        std::min({views_before(face[0]), views_before(face[1]), views_before(face[2])}));
}

} // namespace

bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Vector3d& normal)
{
    const auto track = scene.tracks[point];
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return stands_before(scene.views[view].center, scene.positions[point], normal);
    });
}

bool is_seen(const Scene& scene, const Face& points, const Vector3d& normal)
{
    return std::ranges::all_of(
        points, [&](std::uint32_t point) { return is_seen_from_front(scene, point, normal); });
}

FaceFlags faces_seen_at_corners(const TriMesh& mesh, const Scene& scene)
{
    FaceFlags seen(mesh.faces.size());
    parallel_for(seen.size(), [&](std::size_t i) {
        const auto& [a, b, c] = mesh.faces[i];
        seen[i] = is_seen(scene, {mesh.points[a], mesh.points[b], mesh.points[c]},
                          face_normal(mesh.positions, mesh.faces[i]))
                      ? 1
                      : 0;
    });
    return seen;
}

std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene)
{
    std::vector<std::int32_t> supports(mesh.faces.size());
    parallel_for(supports.size(),
                 [&](std::size_t i) { supports[i] = face_support(mesh, scene, mesh.faces[i]); });
    return supports;
}

} // namespace vcarve
