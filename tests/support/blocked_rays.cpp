#include "support/blocked_rays.h"

#include "base/statistics.h"
#include "geometry/predicates.h"

#include <algorithm>

namespace vcarve::testing {

using Eigen::Vector3d;

bool meets(const Triangle& triangle, const Vector3d& from, const Vector3d& to)
{
    const auto& [a, b, c] = triangle;
    if (orientation(a, b, c, from) * orientation(a, b, c, to) > 0) return false;
    const std::array<int, 3> turns = {orientation(from, to, a, b), orientation(from, to, b, c),
                                      orientation(from, to, c, a)};
    const auto [least, most] = std::ranges::minmax(turns);
    return least >= 0 || most <= 0;
}

std::vector<Triangle> triangles_of(const TriMesh& mesh)
{
    std::vector<Triangle> triangles;
    for (const Face& face : mesh.faces) {
        triangles.push_back(
            {mesh.positions[face[0]], mesh.positions[face[1]], mesh.positions[face[2]]});
    }
    return triangles;
}

Vector3d trimmed(const Scene& scene, std::uint32_t point, std::uint32_t view, double margin)
{
    const Vector3d line = scene.views[view].center - scene.positions[point];
    return scene.positions[point] + line * (margin / line.norm());
}

std::set<std::pair<std::uint32_t, std::uint32_t>>
blocked_rays(const Scene& scene, const TriMesh& mesh, const std::vector<double>& margins)
{
    const std::vector<Triangle> triangles = triangles_of(mesh);
    std::set<std::pair<std::uint32_t, std::uint32_t>> blocked;
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            const Vector3d& center = scene.views[view].center;
            if ((center - scene.positions[point]).norm() <= margins[point]) continue;
            const Vector3d begin = trimmed(scene, point, view, margins[point]);
            if (std::ranges::any_of(triangles,
                                    [&](const Triangle& t) { return meets(t, begin, center); })) {
                blocked.emplace(point, view);
            }
        }
    }
    return blocked;
}

std::vector<double> spacings_of(const TriMesh& mesh)
{
    std::vector<std::vector<double>> lengths(mesh.positions.size());
    for (const Face& face : mesh.faces) {
        for (const std::uint32_t from : face) {
            for (const std::uint32_t to : face) {
                if (from == to) continue;
                lengths[from].push_back((mesh.positions[from] - mesh.positions[to]).norm());
            }
        }
    }
    std::vector<double> spacings;
    for (const std::vector<double>& around : lengths) {
        spacings.push_back(median(around));
    }
    return spacings;
}

std::vector<double> margins_in(const TriMesh& mesh, const Scene& scene)
{
    const std::vector<double> spacings = spacings_of(mesh);
    std::vector<double> margins(scene.num_points(), 0.0);
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
        if (mesh.points[v] == kNoPoint) continue;
        double& margin = margins[mesh.points[v]];
        margin = margin > 0.0 ? std::min(margin, spacings[v]) : spacings[v];
    }
    return margins;
}

TriMesh flat_grid(std::uint32_t n)
{
    TriMesh mesh;
    for (std::uint32_t v = 0; v < n * n; ++v) {
        mesh.positions.emplace_back(v % n / (n - 1.0), v / n / (n - 1.0), 0.0);
        mesh.points.push_back(v);
    }
    for (std::uint32_t y = 0; y + 1 < n; ++y) {
        for (std::uint32_t x = 0; x + 1 < n; ++x) {
            const std::uint32_t v = x + n * y;
            mesh.faces.push_back({v, v + 1, v + n + 1});
            mesh.faces.push_back({v, v + n + 1, v + n});
        }
    }
    return mesh;
}

Scene empty_scene()
{
    return {};
}

} // namespace vcarve::testing
