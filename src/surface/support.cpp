#include "surface/support.h"

#include "base/parallel.h"
#include "surface/edge_table.h"
#include "surface/union_find.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <numeric>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Flags = std::vector<std::uint8_t>; ///< one a face

template <typename Claim>
Flags flags_where(const std::vector<Face>& faces, const Claim& claim)
{
    Flags flags(faces.size());
    parallel_for(flags.size(), [&](std::size_t i) { flags[i] = claim(i) ? 1 : 0; });
    return flags;
}

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

/// Per vertex the median length of the edges of the measured faces around it; 0 where there are
/// none.
std::vector<double> local_edge_lengths(const TriMesh& mesh, const Flags& measured)
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

/// The longest edge of each face over the median edge around it, measured at its middle corner: not
/// at the one that knows only the face itself, nor at the one in the densest place.
std::vector<double> relative_sizes(const TriMesh& mesh, const Flags& measured)
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

/// Per face, the patch of unseen faces it belongs to, as the least of their numbers.
UnionFind unseen_patches(const TriMesh& mesh, const Flags& seen)
{
    UnionFind patches(mesh.faces.size());
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    for (std::size_t edge = 0; edge < edges.size(); ++edge) {
        std::uint32_t first = kNoPoint;
        for (const Side side : edges[edge]) {
            const std::uint32_t face = side / 3;
            if (seen[face] != 0) {
                continue;
            }
            if (first != kNoPoint) {
                patches.join(first, face);
            }
            first = face;
        }
    }
    return patches;
}

/// Which unseen faces lie in patches of a few small faces: gaps in a surface seen around them.
Flags gap_faces(const TriMesh& mesh, const Flags& seen, const std::vector<double>& sizes,
                double max_edge)
{
    constexpr std::int64_t kMaxFaces = 20;
    UnionFind patches = unseen_patches(mesh, seen);
    std::vector<std::int64_t> counts(mesh.faces.size(), 0);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        counts[patches.root(face)] += sizes[face] <= max_edge ? 1 : kMaxFaces + 1;
    }
    Flags gaps(mesh.faces.size(), 0);
    for (std::uint32_t face = 0; face < mesh.faces.size(); ++face) {
        gaps[face] = seen[face] == 0 && counts[patches.root(face)] <= kMaxFaces ? 1 : 0;
    }
    return gaps;
}

} // namespace

TriMesh keep_supported(const TriMesh& mesh, const Scene& scene, const SupportOptions& options)
{
    const Flags seen = flags_where(
        mesh.faces, [&](std::size_t i) { return is_face_seen(mesh, scene, mesh.faces[i]); });
    const std::vector<double> sizes = relative_sizes(mesh, seen);
    const Flags gaps = gap_faces(mesh, seen, sizes, options.max_gap_edge);
    TriMesh result = mesh;
    result.faces.clear();
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const bool fits = options.max_edge == 0.0 || sizes[i] <= options.max_edge;
        if ((seen[i] != 0 && fits) || gaps[i] != 0) {
            result.faces.push_back(mesh.faces[i]);
        }
    }
    return result;
}

} // namespace vcarve
