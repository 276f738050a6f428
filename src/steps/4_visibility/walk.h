#pragma once

#include "base/arrays.h"
#include "model/tet_mesh.h"
#include "steps/4_visibility/exact_walk.h"
#include "steps/4_visibility/sight_frame.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vcarve {

/// From a vertex of a triangulation to any target.
struct Sight {
    Index vertex;
    Eigen::Vector3d target;
};

/// Walks along sights, exactly. Holds where it was, so that the sights of one vertex, walked one
/// after another, find their first cell at once. A step costs one new vertex and three 2x2
/// determinants; where rounding leaves a sign open, exact predicates decide, and where that sign is
/// zero, ExactWalk goes on to the end.
class SightWalk {
  public:
    /// Stands nowhere: for along_each() only, until stand_at().
    explicit SightWalk(const TetMesh& mesh) : mesh_(mesh) {}
    SightWalk(const TetMesh& mesh, Index vertex) : mesh_(mesh) { stand_at(vertex); }

    /// Where the next sights begin.
    void stand_at(Index vertex)
    {
        vertex_ = vertex;
        star_cell_ = mesh_.cell_of_vertex[vertex];
    }

    /// Calls on_crossing(cell, slot) for every facet the segment from the vertex to the target
    /// crosses, from the vertex on: it leaves `cell` by facet `slot`. Never loops.
    template <typename OnCrossing>
    WalkEnds to(const Eigen::Vector3d& target, const OnCrossing& on_crossing)
    {
        Walker walker;
        if (start({vertex_, target}, walker, on_crossing)) {
            do {
                fetch_tip(walker);
            } while (step(walker, on_crossing));
        }
        return walker.ends;
    }

    /// Walks through the middle of a facet to the target, out of the facet's cell, and on into each
    /// next cell for as long as goes_on(facet) says so, the facet being the one to be crossed next,
    /// seen from the cell before it. Returns the facet at which it was stopped:
    /// the given one where `place`, which is to lie inside it, does not as seen along the sight. An
    /// infinite cell number where nothing stopped it before the target or the hull. Plays no part
    /// in walks from vertices.
    template <typename GoesOn>
    CellFacet through_facet(const CellFacet& facet, const Eigen::Vector3d& place,
                            const Eigen::Vector3d& target, const GoesOn& goes_on) const
    {
        Walker walker;
        if (!start_in_facet(facet, SightFrame(place, target), walker)) return facet;
        CellFacet stopped{kInfinite, 0};
        const auto note_stop = [&](Index cell, int slot) {
            if (stopped.cell == kInfinite && !goes_on(CellFacet{cell, slot}))
                stopped = {cell, slot};
        };
        note_stop(walker.exit.cell, walker.exit.slot);
        bool ahead = enter_first(walker, note_stop);
        while (ahead && stopped.cell == kInfinite) {
            fetch_tip(walker);
            ahead = step(walker, note_stop);
        }
        return stopped;
    }

    /// Walks along sight_at(k) for all k below `count`, several at a time, a step each in turn: a
    /// walk mostly waits for memory and for its own last step, and so the others go on meanwhile.
    /// Calls on_crossing(k, cell, slot) as to() does, for each k in order of its walk, which goes
    /// on as long as that says so, and on_end(k, ends) at the end of those that were not stopped. A
    /// walk that the exact one took over may still call on_crossing after it was stopped. Sights of
    /// one vertex should follow each other.
    template <typename SightAt, typename OnCrossing, typename OnEnd>
    void along_each(std::size_t count, const SightAt& sight_at, const OnCrossing& on_crossing,
                    const OnEnd& on_end)
    {
        std::array<Walker, kAbreast> walkers;
        std::size_t active = 0;
        std::size_t next = 0;
        while (active > 0 || next < count) {
            for (; active < kAbreast && next < count; ++next) {
                Walker& walker = walkers[active];
                walker.k = next;
                bool goes_on = true;
                const auto cross = [&](Index cell, int slot) {
                    goes_on = on_crossing(next, cell, slot);
                };
                if (start(sight_at(next), walker, cross)) {
                    ++active;
                } else if (goes_on) {
                    on_end(next, walker.ends);
                }
            }
            for (std::size_t i = 0; i < active; ++i) {
                fetch_tip(walkers[i]);
            }
            for (std::size_t i = active; i-- > 0;) {
                Walker& walker = walkers[i];
                bool goes_on = true;
                const auto cross = [&](Index cell, int slot) {
                    goes_on = on_crossing(walker.k, cell, slot);
                };
                const bool ended = !step(walker, cross);
                if (ended && goes_on) on_end(walker.k, walker.ends);
                if (ended || !goes_on) walkers[i] = walkers[--active];
            }
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
        Index beyond = kInfinite; ///< the cell across the facet
        int entered_by = 0;       ///< the facet's slot there
        unsigned far = 0;         ///< bit k: corner k may lie as far as the target
        std::array<Index, 3> corners{};
        std::array<Sighted, 3> sighted{};
    };
    enum class Found { cell, outside_hull, unclear };

    Found find_first_cell(const SightFrame& frame, Exit& exit) const;
    bool passes_facet(const SightFrame& frame, const Exit& exit) const;
    int corner_to_replace(const SightFrame& frame, const Exit& exit, const Sighted& tip_sighted,
                          const Eigen::Vector3d& tip_position) const;
    bool enter_beyond(const SightFrame& frame, Index tip, Exit& exit) const;

    static constexpr std::size_t kAbreast = 8;
    static constexpr double kMargin = 1e-12; ///< far above the rounding of a depth

    /// A walk on its way.
    struct Walker {
        SightFrame frame;
        Exit exit;
        Index tip = kInfinite; ///< the corner across the facet ahead
        WalkEnds ends;
        std::size_t k = 0; ///< which walk it is
    };

    /// Finds the first cell. Returns false if that is the end already, or the exact walk went all
    /// the way.
    template <typename Cross>
    bool start(const Sight& sight, Walker& walker, const Cross& cross)
    {
        if (sight.vertex != vertex_) stand_at(sight.vertex);
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        if (point == sight.target) {
            walker.ends = {kInfinite, mesh_.cell_of_vertex[vertex_]};
            return false;
        }
        walker.frame = SightFrame(point, sight.target);
        const Found found = find_first_cell(walker.frame, walker.exit);
        if (found == Found::outside_hull) {
            walker.ends = {kInfinite, walker.exit.cell};
            return false;
        }
        if (found == Found::unclear) {
            ExactWalk walk(mesh_, point, sight.target);
            walker.ends = walk.from_vertex(vertex_);
            report(walk, cross);
            return false;
        }
        star_cell_ = walker.exit.cell;
        walker.ends = {walker.exit.cell, kInfinite};
        look_ahead(walker.exit);
        return true;
    }

    /// Stands before a facet. Returns false if the sight does not clearly pass through its inside.
    bool start_in_facet(const CellFacet& facet, const SightFrame& frame, Walker& walker) const
    {
        const Cell& cell = mesh_.cells[facet.cell];
        Exit& exit = walker.exit;
        walker.frame = frame;
        exit.cell = facet.cell;
        exit.slot = facet.slot;
        for (int i = 0; i < 3; ++i) {
            exit.corners[i] = cell.vertices[kFacetCorners[facet.slot][i]];
            exit.sighted[i] = frame.project(mesh_.positions[exit.corners[i]]);
        }
        look_ahead(exit);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            if (frame.turn(exit.sighted[i], exit.sighted[j], mesh_.positions[exit.corners[i]],
                           mesh_.positions[exit.corners[j]]) <= 0) {
                return false;
            }
        }
        return true;
    }

    /// Crosses the facet it stands before. Returns false if the walk ends with that.
    template <typename Cross>
    bool enter_first(Walker& walker, const Cross& cross) const
    {
        fetch_tip(walker);
        walker.ends.last = walker.exit.beyond;
        return walker.tip != kInfinite && enter_or_finish(walker, cross);
    }

    /// Crosses the facet ahead. Returns false if the walk ends with that or before.
    template <typename Cross>
    bool step(Walker& walker, const Cross& cross) const
    {
        Exit& exit = walker.exit;
        if (exit.far != 0 && !passes_facet(walker.frame, exit)) {
            walker.ends.last = exit.cell;
            return false;
        }
        cross(exit.cell, exit.slot);
        walker.ends.last = exit.beyond;
        return walker.tip != kInfinite && enter_or_finish(walker, cross);
    }

    /// Finds the next facet ahead. Returns false if the exact walk went all the way.
    template <typename Cross>
    bool enter_or_finish(Walker& walker, const Cross& cross) const
    {
        if (enter_beyond(walker.frame, walker.tip, walker.exit)) {
            return true;
        }
        ExactWalk walk(mesh_, walker.frame.point(), walker.frame.target());
        walker.ends.last = walk.from_cell(walker.ends.last);
        report(walk, cross);
        return false;
    }

    template <typename Cross>
    static void report(const ExactWalk& walk, const Cross& cross)
    {
        for (const auto [cell, slot] : walk.crossed()) {
            cross(cell, slot);
        }
    }

    static unsigned may_reach_target(const Sighted& corner)
    {
        return static_cast<unsigned>(!(corner.depth < 1.0 - kMargin)); // nor if it is no number
    }

    void look_ahead(Exit& exit) const
    {
        exit.far = 0;
        for (int k = 0; k < 3; ++k) {
            exit.far |= may_reach_target(exit.sighted[k]) << k;
        }
        look_beyond(exit);
    }

    void look_beyond(Exit& exit) const
    {
        exit.beyond = mesh_.cells[exit.cell].neighbors[exit.slot];
        exit.entered_by = mesh_.mirror(exit.cell, exit.slot);
        prefetch(&mesh_.cells[exit.beyond]);
    }

    void fetch_tip(Walker& walker) const
    {
        walker.tip = mesh_.cells[walker.exit.beyond].vertices[walker.exit.entered_by];
        prefetch(&mesh_.positions[walker.tip == kInfinite ? 0 : walker.tip]);
    }

    const TetMesh& mesh_;
    Index vertex_ = kInfinite;
    Index star_cell_ = kInfinite; ///< a finite cell at the vertex, near where the last sight went
};

/// Where a cell keeps one of its vertices. Without branches, which no processor foresees.
inline int slot_of(const Cell& cell, Index vertex)
{
    const bool is_third = cell.vertices[3] == vertex;
    const auto odd = static_cast<int>((cell.vertices[1] == vertex) | is_third);
    const auto high = static_cast<int>((cell.vertices[2] == vertex) | is_third);
    return odd | high << 1;
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
inline bool SightWalk::enter_beyond(const SightFrame& frame, Index tip, Exit& exit) const
{
    const Eigen::Vector3d& tip_position = mesh_.positions[tip];
    const Sighted tip_sighted = frame.project(tip_position);
    const int replaced = corner_to_replace(frame, exit, tip_sighted, tip_position);
    if (replaced < 0) {
        return false;
    }
    const Index left_out = exit.corners[replaced];
    exit.corners[replaced] = tip;
    exit.sighted[replaced] = tip_sighted;
    exit.far = (exit.far & ~(1U << replaced)) | may_reach_target(tip_sighted) << replaced;
    exit.cell = exit.beyond;
    exit.slot = slot_of(mesh_.cells[exit.cell], left_out);
    look_beyond(exit);
    return true;
}

} // namespace vcarve
