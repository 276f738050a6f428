#include "steps/4_visibility/view_walk.h"

#include "geometry/predicates.h"
#include "geometry/triangle.h"

#include <algorithm>

namespace vcarve {

using Eigen::Vector3d;

ViewWalk::ViewWalk(const TetMesh& mesh, const Vector3d& eye, Index vertex)
    : mesh_(mesh), eye_(eye), cell_(RayWalk(mesh, vertex).to(eye, [](Index, int) {}).last)
{
    if (cell_ != kInfinite && mesh_.cells[cell_].is_infinite() && !is_before_hull(cell_)) {
        cell_ = kInfinite;
    }
}

/// Whether the eye is strictly outside the hull facet of an infinite cell.
bool ViewWalk::is_before_hull(Index cell) const
{
    const auto& [a, b, c, infinite] = mesh_.cells[cell].vertices;
    return orientation(mesh_.positions[a], mesh_.positions[b], mesh_.positions[c], eye_) > 0;
}

/// The side on which the line passes each edge of a facet: all +1 if it leaves the facet's cell by
/// the facet.
std::array<int, 3> ViewWalk::turns(const RayFrame& frame, const CellFacet& facet) const
{
    std::array<const Vector3d*, 3> corners{};
    std::ranges::transform(kFacetCorners[facet.slot], corners.begin(), [&](int corner) {
        return &mesh_.positions[mesh_.cells[facet.cell].vertices[corner]];
    });
    std::array<int, 3> turns{};
    for (int i = 0; i < 3; ++i) {
        const Vector3d& from = *corners[i];
        const Vector3d& to = *corners[(i + 1) % 3];
        turns[i] = frame.turn(frame.project(from), frame.project(to), from, to);
    }
    return turns;
}

/// The facet by which the line leaves the finite cell that contains the eye.
ViewWalk::First ViewWalk::way_out(const RayFrame& frame) const
{
    for (int slot = 0; slot < 4; ++slot) {
        const std::array<int, 3> sides = turns(frame, {cell_, slot});
        if (std::ranges::count(sides, 1) == 3) return {{cell_, slot}, true};
    }
    return {};
}

/// Walks from facet to facet of the hull, each time across an edge with the line on its far side.
/// The facets in front of the eye project to a regular triangulation of a convex polygon, in which
/// no such walk returns (Edelsbrunner, "An acyclicity theorem for cell complexes in d dimension",
/// Combinatorica 10, 1990).
ViewWalk::First ViewWalk::way_into_hull(const RayFrame& frame) const
{
    Index cell = cell_;
    // No facet is visited twice, so the loop ends before this limit.
    for (std::size_t steps = 0; steps < mesh_.cells.size(); ++steps) {
        const std::array<int, 3> sides = turns(frame, {cell, kHullSlot});
        const auto across = std::ranges::find(sides, -1) - sides.begin();
        if (across == 3) {
            const bool is_clear = std::ranges::count(sides, 0) == 0;
            return is_clear ? First{{cell, kHullSlot}, true} : First{};
        }
        cell = mesh_.cells[cell].neighbors[kFacetCorners[kHullSlot][(across + 2) % 3]];
        if (!is_before_hull(cell)) return {{kInfinite, 0}, true}; // the line misses the hull
    }
    return {};
}

ViewWalk::First ViewWalk::first_facet(const RayFrame& frame) const
{
    return mesh_.cells[cell_].is_infinite() ? way_into_hull(frame) : way_out(frame);
}

/// The intersection of the line from the eye with the plane of a facet.
Vector3d ViewWalk::place_on(const CellFacet& facet, const Vector3d& direction) const
{
    const auto& [i, j, k] = kFacetCorners[facet.slot];
    const auto& vertices = mesh_.cells[facet.cell].vertices;
    const Vector3d& a = mesh_.positions[vertices[i]];
    const Vector3d normal =
        scaled_normal(a, mesh_.positions[vertices[j]], mesh_.positions[vertices[k]]);
    return eye_ + normal.dot(a - eye_) / normal.dot(direction) * direction;
}

} // namespace vcarve
