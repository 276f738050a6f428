#pragma once

#include "base/arrays.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

using Index = std::uint32_t;
inline constexpr Index kInfinite = 0xffffffffU; ///< the infinite vertex of all infinite cells

inline constexpr int kHullSlot = 3; ///< slot of an infinite cell's facet on the convex hull

/// A tetrahedron. neighbors[i] is the cell behind facet i, which is opposite vertices[i].
///
///            3              orientation(v0, v1, v2, v3) is positive:
///           /|\             the triangle 0 1 2 is counter-clockwise seen from 3.
///          / | \            .
///         0--|--2           An infinite cell has kInfinite in vertices[3]; its facet 3 is a facet
///          \ | /            of the convex hull, and orientation(v0, v1, v2, x) is positive for x
///           \|/             strictly beyond that facet.
///            1
///
/// Aligned so that no cell spans two cache lines.
struct alignas(32) Cell {
    std::array<Index, 4> vertices;
    std::array<Index, 4> neighbors;

    bool is_infinite() const { return vertices[3] == kInfinite; }
    /// The first slot with a finite facet. An infinite cell has only one, the facet of the hull.
    int first_bounded_slot() const { return is_infinite() ? kHullSlot : 0; }
};
static_assert(sizeof(Cell) == 32);

/// The corners of facet i of a cell, counter-clockwise seen from vertex i (from inside the cell):
/// orientation(f0, f1, f2, vertex i) is positive.
inline constexpr std::array<std::array<int, 3>, 4> kFacetCorners = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// A facet as seen from one of its two cells.
struct CellFacet {
    Index cell;
    int slot;
};

/// The Delaunay triangulation of the points of a scene, as flat arrays. Vertex v is point v. Cells
/// are in a canonical order: ascending by their sorted vertices. The vertices of a cell ascend, but
/// the first two are swapped if positive orientation requires it. So the arrays depend only on the
/// points, not on the thread count.
struct TetMesh {
    std::vector<Eigen::Vector3d> positions;
    UnsetArray<Cell> cells;
    UnsetArray<std::uint8_t> mirrors;  ///< 2 bits per facet, see mirror()
    std::vector<Index> cell_of_vertex; ///< a finite cell at each vertex

    /// The slot of `cell` in its neighbor behind facet `slot`: neighbors[mirror] of the neighbor is
    /// `cell`.
    int mirror(Index cell, int slot) const { return (mirrors[cell] >> (2 * slot)) & 3; }

    /// The same facet seen from its other cell.
    CellFacet other_side(const CellFacet& facet) const
    {
        return {cells[facet.cell].neighbors[facet.slot], mirror(facet.cell, facet.slot)};
    }
};

/// The label of a cell: free space or solid.
enum class Label : std::uint8_t { outside = 0, inside = 1 };

/// One label per cell of a TetMesh.
using Labels = std::vector<Label>;

} // namespace vcarve
