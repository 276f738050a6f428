#include "steps/5_labels/needles.h"

#include "base/median.h"
#include "base/parallel.h"
#include "steps/4_visibility/exact_walk.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <set>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The solid angle of a cell at one of its vertices (Van Oosterom and Strackee, IEEE Trans. Biomed.
/// Eng. 30, 1983).
double solid_angle(const TetMesh& mesh, const Cell& cell, Index vertex)
{
    std::array<Vector3d, 3> ways;
    int count = 0;
    for (const Index other : cell.vertices) {
        if (other == vertex) continue;
        ways[count++] = (mesh.positions[other] - mesh.positions[vertex]).normalized();
    }
    const auto& [a, b, c] = ways;
    const double numerator = std::abs(a.dot(b.cross(c)));
    return 2.0 * std::atan2(numerator, 1.0 + a.dot(b) + b.dot(c) + c.dot(a));
}

std::vector<Index> inside_cells_at(const TetMesh& mesh, const Labels& labels, Index vertex)
{
    std::vector<Index> cells = cells_around_vertex(mesh, vertex, mesh.cell_of_vertex[vertex]);
    std::erase_if(cells, [&](Index cell) { return labels[cell] == Label::outside; });
    return cells;
}

/// How many views a point must have to be held for a good one. Those that a scanner measured have
/// fewer, so that they are judged by their shape alone: false echoes are single points, too.
double enough_views(const Scene& scene)
{
    constexpr double kFew = 4.0;
    std::vector<double> counts(scene.num_points());
    parallel_for(counts.size(),
                 [&](std::size_t i) { counts[i] = static_cast<double>(scene.tracks[i].size()); });
    return std::max(kFew, 0.5 * median_in_place(counts));
}

/// Whether every edge of the boundary at a vertex is so many times longer than those at its foot.
bool stands_out(const TetMesh& mesh, const Boundary& boundary, Index vertex, double times)
{
    const auto& edges = boundary.edges();
    return std::ranges::all_of(edges.faces_at()[vertex], [&](std::uint32_t face) {
        return std::ranges::all_of(boundary.faces()[face], [&](std::uint32_t foot) {
            const double length = (mesh.positions[foot] - mesh.positions[vertex]).norm();
            return foot == vertex || length >= times * edges.median(foot);
        });
    });
}

bool is_thin(const TetMesh& mesh, const Labels& labels, Index vertex)
{
    constexpr double kThin = std::numbers::pi / 3.0; // a twelfth of all around
    double sum = 0.0;
    for (const Index cell : inside_cells_at(mesh, labels, vertex)) {
        sum += solid_angle(mesh, mesh.cells[cell], vertex);
    }
    return sum < kThin;
}

/// The points that few views saw.
std::vector<Index> seldom_seen_points(const Scene& scene)
{
    const double enough = enough_views(scene);
    return parallel_collect<Index>(scene.num_points(), [&](std::size_t i, auto& found) {
        if (static_cast<double>(scene.tracks[i].size()) < enough)
            found.push_back(static_cast<Index>(i));
    });
}

/// Those of some points, which ascend, that may have become tips, since the boundary changed at
/// them or at their feet with these cells, which are finite.
std::vector<Index> near_cells(const std::vector<Index>& points, const TetMesh& mesh,
                              const Boundary& boundary, const std::vector<Index>& changed_cells)
{
    std::set<Index> near;
    for (const Index cell : changed_cells) {
        for (const Index vertex : mesh.cells[cell].vertices) {
            for (const std::uint32_t face : boundary.edges().faces_at()[vertex])
                near.insert(boundary.faces()[face].begin(), boundary.faces()[face].end());
        }
    }
    std::vector<Index> found;
    std::ranges::set_intersection(points, near, std::back_inserter(found));
    return found;
}

} // namespace

std::int64_t take_back_needles(const Scene& scene, const NeedleOptions& options,
                               Labelling& labelling)
{
    constexpr int kRounds = 4;
    if (options.needle_edge == 0.0) return 0;
    const std::vector<Index> seldom_seen = seldom_seen_points(scene);
    std::vector<Index> points = seldom_seen;
    std::int64_t taken_back = 0;
    for (int round = 0; round < kRounds; ++round) {
        const TetMesh& cells = labelling.cells();
        const Labels& labels = labelling.labels();
        const Boundary& boundary = labelling.boundary();
        const auto tips = parallel_collect<Index>(points.size(), [&](std::size_t i, auto& found) {
            const Index vertex = points[i];
            if (boundary.edges().faces_at()[vertex].empty()) return;
            if (!stands_out(cells, boundary, vertex, options.needle_edge)) return;
            if (is_thin(cells, labels, vertex)) found.push_back(vertex);
        });
        std::vector<Index> at_tips;
        for (const Index tip : tips) {
            std::ranges::copy(inside_cells_at(cells, labels, tip), std::back_inserter(at_tips));
        }
        labelling.set(at_tips, Label::outside);
        taken_back += static_cast<std::int64_t>(tips.size());
        if (tips.empty()) break;
        points = near_cells(seldom_seen, cells, labelling.boundary(), at_tips);
    }
    return taken_back;
}

} // namespace vcarve
