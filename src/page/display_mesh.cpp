#include "page/display_mesh.h"

#include "geometry/triangle.h"
#include "mesh/collapse_edges.h"
#include "mesh/vertices.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// At most `max_faces` of the faces, evenly chosen.
std::vector<Face> some_faces(const std::vector<Face>& faces, std::size_t max_faces)
{
    std::vector<Face> chosen(std::min(faces.size(), max_faces));
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        chosen[i] = faces[i * faces.size() / chosen.size()];
    }
    return chosen;
}

constexpr std::int32_t kMostParts = 64;

std::vector<double> longest_edges(const TriMesh& mesh)
{
    std::vector<double> lengths;
    lengths.reserve(mesh.faces.size());
    for (const Face& face : mesh.faces) {
        lengths.push_back(longest_edge(mesh.positions, face));
    }
    return lengths;
}

std::vector<std::int32_t> parts_of(const std::vector<double>& lengths, double most)
{
    std::vector<std::int32_t> parts;
    parts.reserve(lengths.size());
    for (const double length : lengths) {
        std::int32_t number = 1;
        while (number < kMostParts && number * most < length) {
            number *= 2;
        }
        parts.push_back(number);
    }
    return parts;
}

} // namespace

TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress)
{
    const auto wanted = static_cast<std::size_t>(std::max<std::int64_t>(max_faces, 1));
    if (mesh.faces.size() <= wanted) return mesh;
    // If boundaries were not locked, small components would vanish.
    TriMesh shown = collapse_edges(mesh, {.min_faces = wanted, .locks_boundary = true});
    progress.report(1.0);
    if (shown.faces.size() <= wanted) return shown;
    return with_used_vertices(shown, some_faces(shown.faces, wanted));
}

std::vector<std::int32_t> edge_parts(const TriMesh& mesh, double length, std::int64_t most)
{
    const std::vector<double> lengths = longest_edges(mesh);
    while (true) {
        std::vector<std::int32_t> parts = parts_of(lengths, length);
        std::int64_t faces = 0;
        for (const std::int32_t number : parts) {
            faces += static_cast<std::int64_t>(number) * number;
        }
        if (faces <= most || faces == std::ssize(parts)) return parts;
        length *= 2.0;
    }
}

std::vector<Eigen::Vector3d> grid_places(const TriMesh& mesh, std::span<const std::int32_t> parts)
{
    std::vector<Eigen::Vector3d> places;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        const Face& face = mesh.faces[f];
        const Eigen::Vector3d& corner = mesh.positions[face[0]];
        const std::int32_t n = parts[f];
        const Eigen::Vector3d along = (mesh.positions[face[1]] - corner) / n;
        const Eigen::Vector3d aside = (mesh.positions[face[2]] - corner) / n;
        for (std::int32_t i = 0; i <= n; ++i) {
            for (std::int32_t j = 0; j <= n - i; ++j) {
                const bool is_corner = i + j == 0 || i == n || j == n;
                if (!is_corner) places.emplace_back(corner + i * along + j * aside);
            }
        }
    }
    return places;
}

} // namespace vcarve
