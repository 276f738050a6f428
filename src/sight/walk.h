#pragma once

#include "model/tet_mesh.h"
#include "sight/exact_walk.h"
#include "sight/sight_frame.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>

namespace vcarve {

/// Walks along sights, from a vertex of the triangulation towards any target, exactly. Holds where
/// it was, so that the sights of one vertex, walked one after another, find their first cell at
/// once. A step costs one new vertex and two 2x2 determinants; where rounding leaves a sign open,
/// exact predicates decide, and where that sign is zero, ExactWalk goes on to the end.
class SightWalk {
  public:
    SightWalk(const TetMesh& mesh, Index vertex)
        : mesh_(mesh), vertex_(vertex), star_cell_(mesh.cell_of_vertex[vertex])
    {
    }

    /// Calls on_crossing(cell, slot) for every facet the segment from the vertex to the target
    /// crosses, from the vertex on: it leaves `cell` by facet `slot`. Never loops.
    template <typename OnCrossing>
    WalkEnds to(const Eigen::Vector3d& target, const OnCrossing& on_crossing)
    {
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        if (point == target) {
            return {kInfinite, mesh_.cell_of_vertex[vertex_]};
        }
        const SightFrame frame(point, target);
        Exit exit;
        const Found found = find_first_cell(frame, exit);
        if (found == Found::outside_hull) {
            return {kInfinite, exit.cell};
        }
        if (found == Found::unclear) {
            ExactWalk walk(mesh_, point, target);
            const WalkEnds ends = walk.from_vertex(vertex_);
            for (const auto [cell, slot] : walk.crossed()) {
                on_crossing(cell, slot);
            }
            return ends;
        }
        star_cell_ = exit.cell;
        return {exit.cell, follow(frame, exit, on_crossing)};
    }

    /// The cell whose interior the segment from the vertex to the target enters first; kInfinite
    /// where it leaves the hull there, or starts in a facet or along an edge.
    Index first_cell(const Eigen::Vector3d& target)
    {
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        Exit exit;
        const Found found =
            point == target ? Found::unclear : find_first_cell(SightFrame(point, target), exit);
        if (found == Found::cell) {
            star_cell_ = exit.cell;
            return exit.cell;
        }
        return found == Found::unclear ? ExactWalk(mesh_, point, target).from_vertex(vertex_).first
                                       : kInfinite;
    }

  private:
    /// The facet ahead: its corners in counter-clockwise order seen from the sight's point.
    struct Exit {
        Index cell = kInfinite;
        int slot = 0;
        std::array<Index, 3> corners{};
        std::array<Sighted, 3> sighted{};
    };
    enum class Found { cell, outside_hull, unclear };

    Found find_first_cell(const SightFrame& frame, Exit& exit) const;
    bool passes_facet(const SightFrame& frame, const Exit& exit) const;
    int corner_to_replace(const SightFrame& frame, const Exit& exit, const Sighted& tip_sighted,
                          const Eigen::Vector3d& tip_position) const;
    bool enter_neighbor(const SightFrame& frame, Exit& exit) const;

    template <typename OnCrossing>
    Index follow(const SightFrame& frame, Exit exit, const OnCrossing& on_crossing) const
    {
        while (passes_facet(frame, exit)) {
            on_crossing(exit.cell, exit.slot);
            const Index next = mesh_.cells[exit.cell].neighbors[exit.slot];
            if (mesh_.cells[next].is_infinite()) {
                return next;
            }
            if (!enter_neighbor(frame, exit)) {
                ExactWalk walk(mesh_, frame.point(), frame.target());
                const Index last = walk.from_cell(next);
                for (const auto [cell, slot] : walk.crossed()) {
                    on_crossing(cell, slot);
                }
                return last;
            }
        }
        return exit.cell;
    }

    const TetMesh& mesh_;
    Index vertex_;
    Index star_cell_; ///< a finite cell at the vertex, near where the last sight went
};

/// Where a cell keeps one of its vertices. Without branches, which no processor foresees.
inline int slot_of(const Cell& cell, Index vertex)
{
    return static_cast<int>(cell.vertices[1] == vertex) +
           2 * static_cast<int>(cell.vertices[2] == vertex) +
           3 * static_cast<int>(cell.vertices[3] == vertex);
}

/// Turns around the vertex towards the target: from a cell to its neighbour across a facet
/// that has the target on its far side.
inline SightWalk::Found SightWalk::find_first_cell(const SightFrame& frame, Exit& exit) const
{
    constexpr int kMaxTurns = 64; // a star has about 27 cells; beyond, the exact walk looks at all
    Index cell = star_cell_;
    for (int turns = 0; turns < kMaxTurns; ++turns) {
        const Cell& here = mesh_.cells[cell];
        exit.cell = cell;
        if (here.is_infinite()) {
            return Found::outside_hull;
        }
        exit.slot = slot_of(here, vertex_);
        for (int i = 0; i < 3; ++i) {
            exit.corners[i] = here.vertices[kFacetCorners[exit.slot][i]];
            exit.sighted[i] = frame.project(mesh_.positions[exit.corners[i]]);
        }
        int outside_of = -1;
        for (int i = 0; i < 3 && outside_of < 0; ++i) {
            const int j = (i + 1) % 3;
            const int turn =
                frame.turn(exit.sighted[i], exit.sighted[j], mesh_.positions[exit.corners[i]],
                           mesh_.positions[exit.corners[j]]);
            if (turn == 0) {
                return Found::unclear;
            }
            outside_of = turn < 0 ? kFacetCorners[exit.slot][(i + 2) % 3] : -1;
        }
        if (outside_of < 0) {
            return Found::cell;
        }
        cell = here.neighbors[outside_of];
    }
    return Found::unclear;
}

/// Whether the target lies strictly beyond the facet ahead.
inline bool SightWalk::passes_facet(const SightFrame& frame, const Exit& exit) const
{
    constexpr double kMargin = 1e-12; // far above the rounding of a depth
    const auto [near, far] =
        std::minmax({exit.sighted[0].depth, exit.sighted[1].depth, exit.sighted[2].depth});
    if (far < 1.0 - kMargin) {
        return true;
    }
    if (near > 1.0 + kMargin) {
        return false;
    }
    return orientation(mesh_.positions[exit.corners[0]], mesh_.positions[exit.corners[1]],
                       mesh_.positions[exit.corners[2]], frame.target()) < 0;
}

/// The corner of the facet ahead that is not on the facet by which the sight leaves the cell beyond,
/// whose tip takes its place; -1 where the sight meets an edge or the tip.
inline int SightWalk::corner_to_replace(const SightFrame& frame, const Exit& exit,
                                        const Sighted& tip_sighted,
                                        const Eigen::Vector3d& tip_position) const
{
    // By the corners that turn left to the tip, 0 in the lowest bit.
    static constexpr std::array<std::int8_t, 8> kReplaced = {0, 1, 2, 1, 0, 0, 2, 0};
    const int left = frame.clear_turns(exit.sighted, tip_sighted);
    if (left >= 0) {
        return kReplaced[left];
    }
    const auto turn_from = [&](int corner) {
        return frame.turn(exit.sighted[corner], tip_sighted, mesh_.positions[exit.corners[corner]],
                          tip_position);
    };
    const int first = turn_from(0);
    const int other = first > 0 ? 2 : 1;
    const int second = first == 0 ? 0 : turn_from(other);
    if (first == 0 || second == 0) {
        return -1;
    }
    if (first > 0) {
        return second < 0 ? 1 : 0;
    }
    return second > 0 ? 2 : 0;
}

/// Steps through the facet ahead and finds the next one. Returns false, `exit` then being of no
/// more use, where the sight meets an edge or the new vertex.
inline bool SightWalk::enter_neighbor(const SightFrame& frame, Exit& exit) const
{
    const int entered_by = mesh_.mirror(exit.cell, exit.slot);
    exit.cell = mesh_.cells[exit.cell].neighbors[exit.slot];
    const Cell& cell = mesh_.cells[exit.cell];
    const Index tip = cell.vertices[entered_by];
    const Eigen::Vector3d& tip_position = mesh_.positions[tip];
    const Sighted tip_sighted = frame.project(tip_position);
    const int replaced = corner_to_replace(frame, exit, tip_sighted, tip_position);
    if (replaced < 0) {
        return false;
    }
    const Index left_out = exit.corners[replaced];
    exit.corners[replaced] = tip;
    exit.sighted[replaced] = tip_sighted;
    exit.slot = slot_of(cell, left_out);
    return true;
}

} // namespace vcarve
