#pragma once

#include "model/tet_mesh.h"
#include "sight/exact_walk.h"
#include "sight/sight_frame.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace vcarve {

/// Walks along sights, from a vertex of the triangulation towards any targets, exactly. Holds where
/// it was, so that the sights of one vertex, walked one after another, find their first cell at
/// once. A step costs one new vertex and three 2x2 determinants; where rounding leaves a sign open,
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
        WalkEnds ends;
        abreast(
            1, [&](std::size_t) -> const Eigen::Vector3d& { return target; },
            [&](std::size_t, Index cell, int slot) { on_crossing(cell, slot); },
            [&](std::size_t, const WalkEnds& found) { ends = found; });
        return ends;
    }

    /// Walks to target_of(k) for all k below `count`, several at a time, a step each in turn: a
    /// walk mostly waits for memory, and so the others go on meanwhile. Calls on_crossing(k, cell,
    /// slot) as to() does, for each k in order of its walk, and on_end(k, ends) at its end.
    template <typename TargetOf, typename OnCrossing, typename OnEnd>
    void to_each(std::size_t count, const TargetOf& target_of, const OnCrossing& on_crossing,
                 const OnEnd& on_end)
    {
        for (std::size_t first = 0; first < count; first += kAbreast) {
            abreast(
                std::min(kAbreast, count - first),
                [&](std::size_t k) -> const Eigen::Vector3d& { return target_of(first + k); },
                [&](std::size_t k, Index cell, int slot) { on_crossing(first + k, cell, slot); },
                [&](std::size_t k, const WalkEnds& ends) { on_end(first + k, ends); });
        }
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

    static constexpr std::size_t kAbreast = 8;

    /// A walk on its way.
    struct Walker {
        SightFrame frame;
        Exit exit;
        Index first;   ///< cell
        std::size_t k; ///< which walk it is
    };

    template <typename TargetOf, typename OnCrossing, typename OnEnd>
    void abreast(std::size_t count, const TargetOf& target_of, const OnCrossing& on_crossing,
                 const OnEnd& on_end)
    {
        std::array<std::optional<Walker>, kAbreast> walkers;
        std::size_t active = 0;
        for (std::size_t k = 0; k < count; ++k) {
            const auto cross = [&](Index cell, int slot) { on_crossing(k, cell, slot); };
            if (start(target_of(k), k, walkers[active], cross, on_end)) {
                fetch_next(walkers[active]->exit);
                ++active;
            }
        }
        while (active > 0) {
            for (std::size_t i = 0; i < active; ++i) {
                fetch_tip(walkers[i]->exit);
            }
            for (std::size_t i = active; i-- > 0;) {
                Walker& walker = *walkers[i];
                const auto cross = [&](Index cell, int slot) { on_crossing(walker.k, cell, slot); };
                const std::optional<Index> last = step(walker, cross);
                if (last) {
                    on_end(walker.k, WalkEnds{walker.first, *last});
                    walkers[i] = walkers[--active];
                } else {
                    fetch_next(walker.exit);
                }
            }
        }
    }

    /// Finds the first cell. Returns false if that is the end already, or the exact walk went all
    /// the way.
    template <typename Cross, typename OnEnd>
    bool start(const Eigen::Vector3d& target, std::size_t k, std::optional<Walker>& walker,
               const Cross& cross, const OnEnd& on_end)
    {
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        if (point == target) {
            on_end(k, WalkEnds{kInfinite, mesh_.cell_of_vertex[vertex_]});
            return false;
        }
        walker.emplace(Walker{SightFrame(point, target), {}, kInfinite, k});
        const Found found = find_first_cell(walker->frame, walker->exit);
        if (found == Found::outside_hull) {
            on_end(k, WalkEnds{kInfinite, walker->exit.cell});
            return false;
        }
        if (found == Found::unclear) {
            ExactWalk walk(mesh_, point, target);
            const WalkEnds ends = walk.from_vertex(vertex_);
            report(walk, cross);
            on_end(k, ends);
            return false;
        }
        star_cell_ = walker->exit.cell;
        walker->first = walker->exit.cell;
        return true;
    }

    /// Crosses the facet ahead; the last cell if the walk ends with that or before.
    template <typename Cross>
    std::optional<Index> step(Walker& walker, const Cross& cross) const
    {
        Exit& exit = walker.exit;
        if (!passes_facet(walker.frame, exit)) {
            return exit.cell;
        }
        cross(exit.cell, exit.slot);
        const Index next = mesh_.cells[exit.cell].neighbors[exit.slot];
        if (mesh_.cells[next].is_infinite()) {
            return next;
        }
        if (enter_neighbor(walker.frame, exit)) {
            return std::nullopt;
        }
        ExactWalk walk(mesh_, walker.frame.point(), walker.frame.target());
        const Index last = walk.from_cell(next);
        report(walk, cross);
        return last;
    }

    template <typename Cross>
    static void report(const ExactWalk& walk, const Cross& cross)
    {
        for (const auto [cell, slot] : walk.crossed()) {
            cross(cell, slot);
        }
    }

    void fetch_next(const Exit& exit) const
    {
        fetch(&mesh_.cells[mesh_.cells[exit.cell].neighbors[exit.slot]]);
    }

    void fetch_tip(const Exit& exit) const
    {
        const Index next = mesh_.cells[exit.cell].neighbors[exit.slot];
        const Index tip = mesh_.cells[next].vertices[mesh_.mirror(exit.cell, exit.slot)];
        if (tip != kInfinite) {
            fetch(&mesh_.positions[tip]);
        }
    }

    static void fetch([[maybe_unused]] const void* address)
    {
#if defined(__GNUC__)
        __builtin_prefetch(address);
#endif
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

/// The corner of the facet ahead that is not on the facet by which the sight leaves the cell
/// beyond, whose tip takes its place; -1 where the sight meets an edge or the tip.
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
