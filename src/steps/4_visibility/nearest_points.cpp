#include "steps/4_visibility/nearest_points.h"

#include "steps/4_visibility/exact_walk.h"

#include <functional>
#include <queue>
#include <unordered_set>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Ranked = std::pair<double, Index>; ///< squared distance and vertex

Ranked ranked(const TetMesh& mesh, const Vector3d& place, Index vertex)
{
    return {(mesh.positions[vertex] - place).squaredNorm(), vertex};
}

/// Calls visit(neighbor) for every finite vertex that shares a cell with a vertex, itself and
/// repetitions included.
template <typename Visit>
void for_each_neighbor(const TetMesh& mesh, Index vertex, const Visit& visit)
{
    for (const Index cell : cells_around_vertex(mesh, vertex, mesh.cell_of_vertex[vertex])) {
        for (const Index neighbor : mesh.cells[cell].vertices) {
            if (neighbor != kInfinite) {
                visit(neighbor);
            }
        }
    }
}

/// Downhill along edges.
Ranked nearest_point(const TetMesh& mesh, const Vector3d& place, Index start)
{
    Ranked nearest = ranked(mesh, place, start);
    Ranked last;
    do {
        last = nearest;
        for_each_neighbor(mesh, last.second, [&](Index neighbor) {
            nearest = std::min(nearest, ranked(mesh, place, neighbor));
        });
    } while (nearest != last);
    return nearest;
}

} // namespace

std::vector<Index> nearest_points(const TetMesh& mesh, const Vector3d& place, std::size_t count,
                                  Index start)
{
    std::priority_queue<Ranked, std::vector<Ranked>, std::greater<>> reached;
    std::unordered_set<Index> known;
    const auto reach = [&](const Ranked& point) {
        if (known.insert(point.second).second) {
            reached.push(point);
        }
    };
    std::vector<Index> points;
    reach(nearest_point(mesh, place, start));
    while (points.size() < count && !reached.empty()) {
        const Index next = reached.top().second;
        reached.pop();
        points.push_back(next);
        for_each_neighbor(mesh, next,
                          [&](Index neighbor) { reach(ranked(mesh, place, neighbor)); });
    }
    return points;
}

} // namespace vcarve
