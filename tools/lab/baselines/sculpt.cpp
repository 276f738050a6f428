#include "baselines/sculpt.h"

#include "baselines/alpha_shape.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

/// The convex hull, from which cells are removed one by one.
class Sculpture {
  public:
    explicit Sculpture(const TetMesh& cells)
        : cells_(cells),
          labels_(cells.cells.size(), Label::inside),
          boundary_facets_(cells.positions.size(), 0),
          buried_(cells.positions.size())
    {
        for (Index cell = 0; cell < labels_.size(); ++cell) {
            if (cells.cells[cell].is_infinite()) labels_[cell] = Label::outside;
        }
        for (Index cell = 0; cell < labels_.size(); ++cell) {
            for (int slot = 0; slot < 4; ++slot) {
                if (is_inside(cell) && is_boundary(cell, slot)) count_facet(cell, slot, 1);
            }
            push(cell);
        }
    }

    /// Removes the next cell. Returns false if no cell may be removed.
    bool take_next()
    {
        while (!queue_.empty()) {
            const Candidate next = queue_.top();
            queue_.pop();
            // Each removed neighbor adds a queue entry for a cell; only the last one is valid.
            const bool current = is_inside(next.cell) && next.bulge == bulge(next.cell);
            if (!current || !may_go(next.cell)) continue;
            take(next.cell);
            return true;
        }
        return false;
    }

    bool is_finished() const { return buried_ == 0; }
    Labels labels() && { return std::move(labels_); }

  private:
    struct Candidate {
        double bulge;
        Index cell;
        bool operator<(const Candidate& other) const
        {
            return bulge != other.bulge ? bulge < other.bulge : cell > other.cell;
        }
    };

    bool is_inside(Index cell) const { return labels_[cell] == Label::inside; }
    bool is_boundary(Index cell, int slot) const
    {
        return !is_inside(cells_.cells[cell].neighbors[slot]);
    }

    std::vector<int> boundary_slots(Index cell) const
    {
        std::vector<int> slots;
        for (int slot = 0; slot < 4; ++slot) {
            if (is_boundary(cell, slot)) slots.push_back(slot);
        }
        return slots;
    }

    /// The largest height of the circumsphere above a boundary facet of the cell.
    double bulge(Index cell) const
    {
        const Circumsphere sphere = circumsphere(cells_, cell);
        double farthest = 0.0;
        for (const int slot : boundary_slots(cell)) {
            const std::array<Index, 4>& corners = cells_.cells[cell].vertices;
            const Eigen::Vector3d& a = cells_.positions[corners[kFacetCorners[slot][0]]];
            const Eigen::Vector3d& b = cells_.positions[corners[kFacetCorners[slot][1]]];
            const Eigen::Vector3d& c = cells_.positions[corners[kFacetCorners[slot][2]]];
            // The corners are counterclockwise from inside.
            const Eigen::Vector3d outward = (c - a).cross(b - a).normalized();
            farthest = std::max(farthest, sphere.radius + outward.dot(sphere.center - a));
        }
        return farthest;
    }

    bool may_go(Index cell) const
    {
        const std::vector<int> slots = boundary_slots(cell);
        const std::array<Index, 4>& corners = cells_.cells[cell].vertices;
        if (slots.size() == 1) return boundary_facets_[corners[slots[0]]] == 0;
        return slots.size() == 2 && is_edge_buried(cell, slots[0], slots[1]);
    }

    /// Whether all cells around the edge between two vertices of an inside cell are inside.
    bool is_edge_buried(Index start, int slot_a, int slot_b) const
    {
        const Index vertex_a = cells_.cells[start].vertices[slot_a];
        const Index vertex_b = cells_.cells[start].vertices[slot_b];
        Index cell = start;
        int exit = other_slot(slot_a, slot_b);
        do {
            const Index next = cells_.cells[cell].neighbors[exit];
            if (!is_inside(next)) return false;
            // Leave through the other facet at the edge.
            const int entry = cells_.mirror(cell, exit);
            const std::array<Index, 4>& corners = cells_.cells[next].vertices;
            exit = 0;
            while (exit == entry || corners[exit] == vertex_a || corners[exit] == vertex_b) {
                ++exit;
            }
            cell = next;
        } while (cell != start);
        return true;
    }

    static int other_slot(int slot_a, int slot_b)
    {
        int slot = 0;
        while (slot == slot_a || slot == slot_b) {
            ++slot;
        }
        return slot;
    }

    /// Adds `change` to the number of boundary facets of the facet's vertices.
    void count_facet(Index cell, int slot, int change)
    {
        for (const int corner : kFacetCorners[slot]) {
            int& count = boundary_facets_[cells_.cells[cell].vertices[corner]];
            if (count == 0) --buried_;
            count += change;
        }
    }

    void take(Index cell)
    {
        // Add the new facets first, so that no vertex temporarily has none.
        std::vector<Index> uncovered;
        const std::vector<int> old_slots = boundary_slots(cell);
        for (int slot = 0; slot < 4; ++slot) {
            if (std::ranges::count(old_slots, slot) > 0) continue;
            count_facet(cell, slot, 1);
            uncovered.push_back(cells_.cells[cell].neighbors[slot]);
        }
        for (const int slot : old_slots) {
            count_facet(cell, slot, -1);
        }
        labels_[cell] = Label::outside;
        for (const Index neighbor : uncovered) {
            push(neighbor);
        }
    }

    void push(Index cell)
    {
        if (is_inside(cell) && !boundary_slots(cell).empty()) queue_.push({bulge(cell), cell});
    }

    const TetMesh& cells_;
    Labels labels_;
    std::vector<int> boundary_facets_; ///< number at each vertex
    std::size_t buried_;               ///< number of vertices not on the boundary
    std::priority_queue<Candidate> queue_;
};

} // namespace

Labels sculpt(const TetMesh& cells, std::size_t most)
{
    Sculpture sculpture(cells);
    for (std::size_t taken = 0; taken < most && !sculpture.is_finished(); ++taken) {
        if (!sculpture.take_next()) break;
    }
    return std::move(sculpture).labels();
}

} // namespace vcarve
