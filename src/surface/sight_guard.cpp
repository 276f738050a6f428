#include "surface/sight_guard.h"

#include "base/parallel.h"
#include "surface/edge_table.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace vcarve {
namespace {

using Eigen::Vector3d;

/// Per point, how much of its sights does not count; of two vertices at a point the lesser.
std::vector<double> margins_of_points(const Scene& scene, const TriMesh& surface)
{
    const std::vector<double> spacings = vertex_spacings(surface);
    std::vector<double> margins(scene.num_points(), 0.0);
    for (std::size_t v = 0; v < surface.points.size(); ++v) {
        const std::uint32_t point = surface.points[v];
        if (point == kNoPoint) continue;
        double& margin = margins[point];
        margin = margin > 0.0 ? std::min(margin, spacings[v]) : spacings[v];
    }
    return margins;
}

} // namespace

std::vector<double> vertex_spacings(const TriMesh& mesh)
{
    // Two lengths a face and corner: an edge amid two faces counts twice, which leaves the median.
    std::vector<std::size_t> begins(mesh.positions.size() + 1, 0);
    for (const Face& face : mesh.faces) {
        for (const std::uint32_t vertex : face) {
            begins[vertex] += 2;
        }
    }
    std::partial_sum(begins.begin(), begins.end(), begins.begin());
    std::vector<double> lengths(begins.back());
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            const std::uint32_t tail = face[i];
            const std::uint32_t head = face[(i + 1) % 3];
            const double length = (mesh.positions[head] - mesh.positions[tail]).norm();
            lengths[--begins[tail]] = length;
            lengths[--begins[head]] = length;
        }
    }
    std::vector<double> medians(mesh.positions.size(), 0.0);
    parallel_for(medians.size(), [&](std::size_t vertex) {
        const auto begin = lengths.begin() + static_cast<std::ptrdiff_t>(begins[vertex]);
        const auto end = lengths.begin() + static_cast<std::ptrdiff_t>(begins[vertex + 1]);
        if (begin == end) return;
        const auto middle = begin + (end - begin) / 2;
        std::nth_element(begin, middle, end);
        medians[vertex] = *middle;
    });
    return medians;
}

SightGuard::SightGuard(const Scene& scene, const TriMesh& surface)
    : tree_(scene, margins_of_points(scene, surface)), blocked_(tree_.size(), 0)
{
    parallel_for(
        surface.faces.size(),
        [&](std::size_t f) {
            const Face& face = surface.faces[f];
            tree_.visit_meeting(
                {surface.positions[face[0]], surface.positions[face[1]],
                 surface.positions[face[2]]},
                [&](std::size_t sight) {
                    std::atomic_ref(blocked_[sight]).store(1, std::memory_order_relaxed);
                    return true;
                });
        },
        64);
}

bool SightGuard::blocks(const std::array<Vector3d, 3>& triangle) const
{
    bool found = false;
    tree_.visit_meeting(triangle, [&](std::size_t sight) {
        found = blocked_[sight] == 0;
        return !found;
    });
    return found;
}

std::int64_t SightGuard::num_free() const
{
    return std::ranges::count(blocked_, 0);
}

} // namespace vcarve
