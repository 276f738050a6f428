#pragma once

#include "base/arrays.h"
#include "model/tet_mesh.h"
#include "steps/4_visibility/exact_walk.h"
#include "steps/4_visibility/ray_frame.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace vcarve {

/// A ray from a vertex of a triangulation to any target.
struct Ray {
    Index vertex;
    Eigen::Vector3d target;
};

/// Walks along rays, exactly. Remembers its last first cell, so that consecutive rays of one vertex
/// find theirs quickly. A step costs one new vertex and three 2x2 determinants. If rounding leaves
/// a sign uncertain, exact predicates decide. If the exact sign is zero, ExactWalk completes the
/// walk.
class RayWalk {
  public:
    /// Without a vertex: only along_each() may be called before move_to().
    explicit RayWalk(const TetMesh& mesh) : mesh_(mesh) {}
    RayWalk(const TetMesh& mesh, Index vertex) : mesh_(mesh) { move_to(vertex); }

    /// Sets the vertex of the next rays.
    void move_to(Index vertex)
    {
        vertex_ = vertex;
        star_cell_ = mesh_.cell_of_vertex[vertex];
    }

    /// Calls on_crossing(cell, slot) for each facet that the segment from the vertex to the target
    /// crosses, in order. The segment leaves `cell` by facet `slot`. Always ends.
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

    /// Walks from `place`, a position inside a facet, out of the facet's cell to the target. Calls
    /// continues(facet) before each facet is crossed, the given one first, each given from the cell
    /// before it. Stops if it returns false. Returns the facet at which it stopped; the given one
    /// if `place` is not inside it, seen along the ray; cell kInfinite if it reached the target or
    /// left the hull. Does not affect walks from vertices.
    template <typename Continues>
    CellFacet through_facet(const CellFacet& facet, const Eigen::Vector3d& place,
                            const Eigen::Vector3d& target, const Continues& continues) const
    {
        Walker walker;
        if (!start_in_facet(facet, RayFrame(place, target), walker)) return facet;
        CellFacet stopped{kInfinite, 0};
        const auto note_stop = [&](Index cell, int slot) {
            if (stopped.cell == kInfinite && !continues(CellFacet{cell, slot}))
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

    /// Walks along ray_at(k) for all k below `count`, several at a time, one step each in turn. A
    /// walk mostly waits for memory and its last step, so the other walks advance meanwhile. Calls
    /// on_crossing(k, cell, slot) as to() does, in order for each k, and stops walk k if it returns
    /// false. Calls on_end(k, ends) for walks that were not stopped. The exact walk may call
    /// on_crossing after a stop. Rays of one vertex should be consecutive.
    template <typename RayAt, typename OnCrossing, typename OnEnd>
    void along_each(std::size_t count, const RayAt& ray_at, const OnCrossing& on_crossing,
                    const OnEnd& on_end)
    {
        std::array<Walker, kAbreast> walkers;
        std::size_t active = 0;
        std::size_t next = 0;
        while (active > 0 || next < count) {
            for (; active < kAbreast && next < count; ++next) {
                Walker& walker = walkers[active];
                walker.k = next;
                bool continues = true;
                const auto cross = [&](Index cell, int slot) {
                    continues = on_crossing(next, cell, slot);
                };
                if (start(ray_at(next), walker, cross)) {
                    ++active;
                } else if (continues) {
                    on_end(next, walker.ends);
                }
            }
            for (std::size_t i = 0; i < active; ++i) {
                fetch_tip(walkers[i]);
            }
            for (std::size_t i = active; i-- > 0;) {
                Walker& walker = walkers[i];
                bool continues = true;
                const auto cross = [&](Index cell, int slot) {
                    continues = on_crossing(walker.k, cell, slot);
                };
                const bool ended = !step(walker, cross);
                if (ended && continues) on_end(walker.k, walker.ends);
                if (ended || !continues) walkers[i] = walkers[--active];
            }
        }
    }

    /// The cell whose interior the segment from the vertex to the target enters first; kInfinite if
    /// it leaves the hull there, or starts in a facet or along an edge.
    Index first_cell(const Eigen::Vector3d& target)
    {
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        Exit exit;
        const Found found =
            point == target ? Found::unclear : find_first_cell(RayFrame(point, target), exit);
        if (found == Found::cell) {
            star_cell_ = exit.cell;
            return exit.cell;
        }
        return found == Found::unclear ? ExactWalk(mesh_, point, target).from_vertex(vertex_).first
                                       : kInfinite;
    }

  private:
    /// The facet ahead, with its corners counter-clockwise seen from the ray's point.
    struct Exit {
        Index cell = kInfinite;
        int slot = 0;
        Index beyond = kInfinite; ///< the cell across the facet
        int entered_by = 0;       ///< the facet's slot in `beyond`
        unsigned far = 0;         ///< bit k: corner k may be as deep as the target
        std::array<Index, 3> corners{};
        std::array<Rayed, 3> rayed{};
    };
    enum class Found { cell, outside_hull, unclear };

    Found find_first_cell(const RayFrame& frame, Exit& exit) const;
    bool passes_facet(const RayFrame& frame, const Exit& exit) const;
    int corner_to_replace(const RayFrame& frame, const Exit& exit, const Rayed& tip_rayed,
                          const Eigen::Vector3d& tip_position) const;
    bool enter_beyond(const RayFrame& frame, Index tip, Exit& exit) const;

    static constexpr std::size_t kAbreast = 8;
    static constexpr double kMargin = 1e-12; ///< far above the rounding of a depth

    /// The state of a walk.
    struct Walker {
        RayFrame frame;
        Exit exit;
        Index tip = kInfinite; ///< the vertex of the cell beyond that is not on the facet ahead
        WalkEnds ends;
        std::size_t k = 0; ///< index of the walk
    };

    /// Finds the first cell. Returns false if the walk ends there, or the exact walk completed it.
    template <typename Cross>
    bool start(const Ray& ray, Walker& walker, const Cross& cross)
    {
        if (ray.vertex != vertex_) move_to(ray.vertex);
        const Eigen::Vector3d& point = mesh_.positions[vertex_];
        if (point == ray.target) {
            walker.ends = {kInfinite, mesh_.cell_of_vertex[vertex_]};
            return false;
        }
        walker.frame = RayFrame(point, ray.target);
        const Found found = find_first_cell(walker.frame, walker.exit);
        if (found == Found::outside_hull) {
            walker.ends = {kInfinite, walker.exit.cell};
            return false;
        }
        if (found == Found::unclear) {
            ExactWalk walk(mesh_, point, ray.target);
            walker.ends = walk.from_vertex(vertex_);
            report(walk, cross);
            return false;
        }
        star_cell_ = walker.exit.cell;
        walker.ends = {walker.exit.cell, kInfinite};
        look_ahead(walker.exit);
        return true;
    }

    /// Starts before a facet. Returns false if the ray does not clearly pass through its interior.
    bool start_in_facet(const CellFacet& facet, const RayFrame& frame, Walker& walker) const
    {
        const Cell& cell = mesh_.cells[facet.cell];
        Exit& exit = walker.exit;
        walker.frame = frame;
        exit.cell = facet.cell;
        exit.slot = facet.slot;
        for (int i = 0; i < 3; ++i) {
            exit.corners[i] = cell.vertices[kFacetCorners[facet.slot][i]];
            exit.rayed[i] = frame.project(mesh_.positions[exit.corners[i]]);
        }
        look_ahead(exit);
        for (int i = 0; i < 3; ++i) {
            const int j = (i + 1) % 3;
            if (frame.turn(exit.rayed[i], exit.rayed[j], mesh_.positions[exit.corners[i]],
                           mesh_.positions[exit.corners[j]]) <= 0) {
                return false;
            }
        }
        return true;
    }

    /// Crosses the first facet. Returns false if the walk ends there.
    template <typename Cross>
    bool enter_first(Walker& walker, const Cross& cross) const
    {
        fetch_tip(walker);
        walker.ends.last = walker.exit.beyond;
        return walker.tip != kInfinite && enter_or_finish(walker, cross);
    }

    /// Crosses the facet ahead. Returns false if the walk ends there or before it.
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

    /// Finds the next facet ahead. Returns false if the exact walk completed the walk.
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

    static unsigned may_reach_target(const Rayed& corner)
    {
        return static_cast<unsigned>(!(corner.depth < 1.0 - kMargin)); // true for NaN
    }

    void look_ahead(Exit& exit) const
    {
        exit.far = 0;
        for (int k = 0; k < 3; ++k) {
            exit.far |= may_reach_target(exit.rayed[k]) << k;
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
    Index star_cell_ = kInfinite; ///< a finite cell at the vertex, near the last ray
};

/// The slot of a vertex in its cell. Branchless, because the branches would be unpredictable.
inline int slot_of(const Cell& cell, Index vertex)
{
    const bool is_third = cell.vertices[3] == vertex;
    const auto odd = static_cast<int>((cell.vertices[1] == vertex) | is_third);
    const auto high = static_cast<int>((cell.vertices[2] == vertex) | is_third);
    return odd | high << 1;
}

/// Walks around the vertex towards the target: from a cell to its neighbor across a facet with the
/// target on the far side.
inline RayWalk::Found RayWalk::find_first_cell(const RayFrame& frame, Exit& exit) const
{
    constexpr int kMaxTurns = 64; // a star has about 27 cells; the exact walk handles larger ones
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
            exit.rayed[i] = frame.project(mesh_.positions[exit.corners[i]]);
        }
        int outside_of = -1;
        for (int i = 0; i < 3 && outside_of < 0; ++i) {
            const int j = (i + 1) % 3;
            const int turn =
                frame.turn(exit.rayed[i], exit.rayed[j], mesh_.positions[exit.corners[i]],
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

/// Whether the target is strictly beyond the facet ahead.
inline bool RayWalk::passes_facet(const RayFrame& frame, const Exit& exit) const
{
    const auto [near, far] =
        std::minmax({exit.rayed[0].depth, exit.rayed[1].depth, exit.rayed[2].depth});
    if (far < 1.0 - kMargin) {
        return true;
    }
    if (near > 1.0 + kMargin) {
        return false;
    }
    return orientation(mesh_.positions[exit.corners[0]], mesh_.positions[exit.corners[1]],
                       mesh_.positions[exit.corners[2]], frame.target()) < 0;
}

/// The corner of the facet ahead that the tip replaces in the facet by which the ray leaves the
/// cell beyond; -1 if the ray meets an edge or the tip.
inline int RayWalk::corner_to_replace(const RayFrame& frame, const Exit& exit,
                                      const Rayed& tip_rayed,
                                      const Eigen::Vector3d& tip_position) const
{
    // The index has a bit for each corner that turns left to the tip, corner 0 in the lowest.
    static constexpr std::array<std::int8_t, 8> kReplaced = {0, 1, 2, 1, 0, 0, 2, 0};
    const int left = frame.clear_turns(exit.rayed, tip_rayed);
    if (left >= 0) {
        return kReplaced[left];
    }
    const auto turn_from = [&](int corner) {
        return frame.turn(exit.rayed[corner], tip_rayed, mesh_.positions[exit.corners[corner]],
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

/// Crosses the facet ahead and finds the next one. Returns false, with `exit` invalid, if the ray
/// meets an edge or the new vertex.
inline bool RayWalk::enter_beyond(const RayFrame& frame, Index tip, Exit& exit) const
{
    const Eigen::Vector3d& tip_position = mesh_.positions[tip];
    const Rayed tip_rayed = frame.project(tip_position);
    const int replaced = corner_to_replace(frame, exit, tip_rayed, tip_position);
    if (replaced < 0) {
        return false;
    }
    const Index left_out = exit.corners[replaced];
    exit.corners[replaced] = tip;
    exit.rayed[replaced] = tip_rayed;
    exit.far = (exit.far & ~(1U << replaced)) | may_reach_target(tip_rayed) << replaced;
    exit.cell = exit.beyond;
    exit.slot = slot_of(mesh_.cells[exit.cell], left_out);
    look_beyond(exit);
    return true;
}

} // namespace vcarve
