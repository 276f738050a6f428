#include "surface/support.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Whether some view of a point's track sees it from the side the unit normal points to.
bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Vector3d& normal)
{
    constexpr double kGrazing = 0.05; // cosine, about 87 degrees off the normal
    const auto track = scene.tracks[point];
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        const Vector3d to_view = scene.views[view].center - scene.positions[point];
        return normal.dot(to_view) > kGrazing * to_view.norm();
    });
}

bool is_face_seen(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    const Vector3d& a = mesh.positions[face[0]];
    const Vector3d normal =
        (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a).normalized();
    return std::all_of(face.begin(), face.end(), [&](std::uint32_t vertex) {
        return is_seen_from_front(scene, mesh.points[vertex], normal);
    });
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

/// Per vertex the median length of the edges of its faces.
std::vector<double> local_edge_lengths(const TriMesh& mesh, const std::vector<Face>& faces)
{
    std::vector<std::size_t> begins(mesh.positions.size() + 1, 0);
    for (const Face& face : faces) {
        for (const std::uint32_t vertex : face) {
            begins[vertex] += 3;
        }
    }
    for (std::size_t sum = 0; std::size_t & begin : begins) {
        sum += begin;
        begin = sum;
    }
    std::vector<double> lengths(begins.back());
    for (const Face& face : faces) {
        for (const std::uint32_t vertex : face) {
            for (int corner = 0; corner < 3; ++corner) {
                lengths[--begins[vertex]] = edge_length(mesh, face, corner);
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

template <typename IsKept>
std::vector<Face> faces_where(const std::vector<Face>& faces, const IsKept& is_kept)
{
    std::vector<std::uint8_t> kept(faces.size());
    parallel_for(faces.size(), [&](std::size_t i) { kept[i] = is_kept(faces[i]) ? 1 : 0; });
    std::vector<Face> result;
    for (std::size_t i = 0; i < faces.size(); ++i) {
        if (kept[i] != 0) {
            result.push_back(faces[i]);
        }
    }
    return result;
}

} // namespace

TriMesh keep_supported(const TriMesh& mesh, const Scene& scene, const SupportOptions& options)
{
    TriMesh result = mesh;
    result.faces =
        faces_where(mesh.faces, [&](const Face& face) { return is_face_seen(mesh, scene, face); });
    if (options.max_edge > 0.0) {
        const std::vector<double> local = local_edge_lengths(mesh, result.faces);
        result.faces = faces_where(result.faces, [&](const Face& face) {
            const double scale = std::max({local[face[0]], local[face[1]], local[face[2]]});
            return longest_edge(mesh, face) <= options.max_edge * scale;
        });
    }
    return result;
}

} // namespace vcarve
