#include "surface/face_evidence.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Whether a view at `center` sees a point from the side the unit normal points to.
bool is_before(const Vector3d& center, const Vector3d& point, const Vector3d& normal)
{
    constexpr double kGrazing = 0.05; // cosine, about 87 degrees off the normal
    const Vector3d to_view = center - point;
    return normal.dot(to_view) > kGrazing * to_view.norm();
}

/// Whether some view of a point's track sees it from the side the unit normal points to.
bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Vector3d& normal)
{
    const auto track = scene.tracks[point];
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return is_before(scene.views[view].center, scene.positions[point], normal);
    });
}

/// How many views saw the least seen corner from the front.
std::int32_t face_support(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    const Vector3d normal = face_normal(mesh, face);
    const auto views_before = [&](std::uint32_t vertex) -> std::ptrdiff_t {
        if (mesh.points[vertex] == kNoPoint) {
            return 0;
        }
        const auto track = scene.tracks[mesh.points[vertex]];
        return std::count_if(track.begin(), track.end(), [&](std::uint32_t view) {
            return is_before(scene.views[view].center, mesh.positions[vertex], normal);
        });
    };
    return static_cast<std::int32_t>(
        std::min({views_before(face[0]), views_before(face[1]), views_before(face[2])}));
}

double edge_length(const TriMesh& mesh, const Face& face, int corner)
{
    return (mesh.positions[face[corner]] - mesh.positions[face[(corner + 1) % 3]]).norm();
}

double longest_edge(const TriMesh& mesh, const Face& face)
{
    return std::max(
        {edge_length(mesh, face, 0), edge_length(mesh, face, 1), edge_length(mesh, face, 2)});
}

/// Per vertex the median length of the edges of the measured faces around it; 0 where there are
/// none.
std::vector<double> local_edge_lengths(const TriMesh& mesh, const FaceFlags& measured)
{
    std::vector<std::size_t> begins(mesh.positions.size() + 1, 0);
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        for (const std::uint32_t vertex : mesh.faces[i]) {
            begins[vertex] += measured[i] != 0 ? 3 : 0;
        }
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<double> lengths(begins.back());
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        for (const std::uint32_t vertex : mesh.faces[i]) {
            for (int corner = 0; corner < 3 && measured[i] != 0; ++corner) {
                lengths[--begins[vertex]] = edge_length(mesh, mesh.faces[i], corner);
            }
        }
    }
    std::vector<double> medians(mesh.positions.size(), 0.0);
    parallel_for(medians.size(), [&](std::size_t vertex) {
        const auto begin = lengths.begin() + static_cast<std::ptrdiff_t>(begins[vertex]);
        const auto end = lengths.begin() + static_cast<std::ptrdiff_t>(begins[vertex + 1]);
        if (begin != end) {
            const auto middle = begin + (end - begin) / 2;
            std::nth_element(begin, middle, end);
            medians[vertex] = *middle;
        }
    });
    return medians;
}

} // namespace

Vector3d face_normal(const TriMesh& mesh, const Face& face)
{
    const Vector3d& a = mesh.positions[face[0]];
    return (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a).normalized();
}

FaceFlags seen_faces(const TriMesh& mesh, const Scene& scene)
{
    FaceFlags seen(mesh.faces.size());
    parallel_for(seen.size(), [&](std::size_t i) {
        const Face& face = mesh.faces[i];
        const Vector3d normal = face_normal(mesh, face);
        seen[i] = std::all_of(face.begin(), face.end(), [&](std::uint32_t vertex) {
            return is_seen_from_front(scene, mesh.points[vertex], normal);
        });
    });
    return seen;
}

std::vector<double> longest_edges(const TriMesh& mesh)
{
    std::vector<double> longest(mesh.faces.size());
    parallel_for(longest.size(),
                 [&](std::size_t i) { longest[i] = longest_edge(mesh, mesh.faces[i]); });
    return longest;
}

std::vector<double> relative_sizes(const TriMesh& mesh, const FaceFlags& measured)
{
    const std::vector<double> local = local_edge_lengths(mesh, measured);
    std::vector<double> sizes(mesh.faces.size());
    parallel_for(sizes.size(), [&](std::size_t i) {
        const Face& face = mesh.faces[i];
        std::array<double, 3> scales = {local[face[0]], local[face[1]], local[face[2]]};
        std::sort(scales.begin(), scales.end());
        sizes[i] = longest_edge(mesh, face) / scales[1];
    });
    return sizes;
}

std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene)
{
    std::vector<std::int32_t> supports(mesh.faces.size());
    parallel_for(supports.size(),
                 [&](std::size_t i) { supports[i] = face_support(mesh, scene, mesh.faces[i]); });
    return supports;
}

} // namespace vcarve
