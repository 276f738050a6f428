#pragma once

#include "base/arrays.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

using Index = std::uint32_t;
inline constexpr Index kInfinite = 0xffffffffU; ///< the vertex all infinite cells share

inline constexpr int kHullSlot = 3; ///< of an infinite cell: its facet of the convex hull

/// A tetrahedron. neighbors[i] lies across facet i, the facet opposite vertices[i].
///
///            3              vertices are ordered so that orientation(v0, v1, v2, v3) is positive:
///           /|\             seen from 3, the triangle 0 1 2 runs counter-clockwise.
///          / | \            .
///         0--|--2           An infinite cell has kInfinite in vertices[3]; its facet 3 is a facet
///          \ | /            of the convex hull, and orientation(v0, v1, v2, x) is positive for x
///           \|/             strictly beyond that facet.
///            1
///
/// Aligned so that none lies across two cache lines.
struct alignas(32) Cell {
    std::array<Index, 4> vertices;
    std::array<Index, 4> neighbors;

    bool is_infinite() const { return vertices[3] == kInfinite; }
    /// The first slot whose facet has an end: of an infinite cell only that of the hull has one.
    int first_bounded_slot() const { return is_infinite() ? kHullSlot : 0; }
};
static_assert(sizeof(Cell) == 32);

/// The corners of facet i of a cell, counter-clockwise seen from vertex i, that is from inside:
/// orientation(f0, f1, f2, vertex i) is positive.
inline constexpr std::array<std::array<int, 3>, 4> kFacetCorners = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// A facet as seen from one of its two cells.
struct CellFacet {
    Index cell;
    int slot;
};

/// The Delaunay triangulation of the points, flat. Vertex v is point v of the scene it was made
/// from. Cells are numbered in a canonical order: ascending by their sorted vertices; within a cell
/// the vertices ascend, but for the first two where positive orientation demands otherwise. So the
/// same points give the same arrays, whatever the number of threads.
struct TetMesh {
    std::vector<Eigen::Vector3d> positions;
    UnsetArray<Cell> cells;
    UnsetArray<std::uint8_t> mirrors;  ///< 2 bits a facet, see mirror()
    std::vector<Index> cell_of_vertex; ///< one finite cell at each vertex

    /// The slot of `cell` in its neighbour across facet `slot`: neighbors[mirror] of that one is
    /// `cell`.
    int mirror(Index cell, int slot) const { return (mirrors[cell] >> (2 * slot)) & 3; }

    /// The same facet as seen from its other cell.
    CellFacet other_side(const CellFacet& facet) const
    {
        return {cells[facet.cell].neighbors[facet.slot], mirror(facet.cell, facet.slot)};
    }
};

/// What a cell is taken for.
enum class Label : std::uint8_t { outside = 0, inside = 1 };

/// One label a cell of a TetMesh.
using Labels = std::vector<Label>;

} // namespace vcarve
