#include "steps/4_visibility/exact_walk.h"

#include "geometry/predicates.h"

#include <algorithm>
#include <cstddef>
#include <unordered_set>
#include <vector>

namespace vcarve {

namespace {

int exact_slot_of(const Cell& cell, Index vertex)
{
    return static_cast<int>(std::find(cell.vertices.begin(), cell.vertices.end(), vertex) -
                            cell.vertices.begin());
}

bool has_vertex(const Cell& cell, Index vertex)
{
    return exact_slot_of(cell, vertex) < 4;
}

std::array<Index, 3> facet_corners(const Cell& cell, int slot)
{
    const auto& corners = kFacetCorners[slot];
    return {cell.vertices[corners[0]], cell.vertices[corners[1]], cell.vertices[corners[2]]};
}

/// The cells around an edge in cyclic order, including infinite cells. `start` is one of them.
std::vector<Index> cells_around_edge(const TetMesh& mesh, Index a, Index b, Index start)
{
    std::vector<Index> ring;
    Index cell = start;
    Index from = kInfinite; // the previous cell
    do {
        ring.push_back(cell);
        Index next = kInfinite;
        for (int slot = 0; slot < 4; ++slot) {
            const Cell& here = mesh.cells[cell];
            const bool holds_edge = here.vertices[slot] != a && here.vertices[slot] != b;
            if (holds_edge && here.neighbors[slot] != from) {
                next = here.neighbors[slot];
                break;
            }
        }
        from = cell;
        cell = next;
    } while (cell != start && cell != kInfinite);
    return ring;
}

/// Whether `middle` is strictly between two points that are collinear with it. Exact.
bool lies_between(const Eigen::Vector3d& from, const Eigen::Vector3d& middle,
                  const Eigen::Vector3d& to)
{
    int axis = 0;
    (middle - from).cwiseAbs().maxCoeff(&axis);
    return (from[axis] < middle[axis] && middle[axis] < to[axis]) ||
           (from[axis] > middle[axis] && middle[axis] > to[axis]);
}

/// A set of cells: a sorted list while it is small, then a hash table. Insertion into a long list
/// would be slow, for example around a point at the center of a sphere of points.
class MetCells {
  public:
    /// Adds a cell and returns whether it is new.
    bool add(Index cell)
    {
        if (!many_.empty()) return many_.insert(cell).second;
        const auto at = std::lower_bound(few_.begin(), few_.end(), cell);
        if (at != few_.end() && *at == cell) return false;
        few_.insert(at, cell);
        if (few_.size() > kFew) many_.insert(few_.begin(), few_.end());
        return true;
    }

  private:
    static constexpr std::size_t kFew = 256;

    std::vector<Index> few_;
    std::unordered_set<Index> many_;
};

} // namespace

std::vector<Index> cells_around_vertex(const TetMesh& mesh, Index vertex, Index start)
{
    std::vector<Index> star{start};
    MetCells met;
    met.add(start);
    for (std::size_t i = 0; i < star.size(); ++i) {
        for (const Index neighbor : mesh.cells[star[i]].neighbors) {
            if (has_vertex(mesh.cells[neighbor], vertex) && met.add(neighbor))
                star.push_back(neighbor);
        }
    }
    return star;
}

/// +1 if the ray's line passes left of the edge from a to b, seen from its point, -1 if right.
int ExactWalk::side_of_line(Index a, Index b) const
{
    return -orientation(point_, target_, position(a), position(b));
}

/// The slot of the vertex of the cell that is not among the three corners of `place`.
int ExactWalk::off_plane_corner(const Position& place) const
{
    const Cell& cell = mesh_.cells[place.cell];
    int slot = 0;
    while (std::find(place.corners.begin(), place.corners.end(), cell.vertices[slot]) !=
           place.corners.end()) {
        ++slot;
    }
    return slot;
}

/// Inside a cell: leaves by the facet, edge or vertex ahead, unless the target comes first.
ExactWalk::Position ExactWalk::leave_cell(Index index)
{
    const Cell& cell = mesh_.cells[index];
    for (int slot = 0; slot < 4; ++slot) {
        const auto [a, b, c] = facet_corners(cell, slot);
        const std::array<int, 3> turns = {side_of_line(a, b), side_of_line(b, c),
                                          side_of_line(c, a)};
        const auto zeros = std::count(turns.begin(), turns.end(), 0);
        if (std::count(turns.begin(), turns.end(), -1) > 0 || zeros == 3) {
            continue; // the line does not leave through this facet
        }
        if (orientation(position(a), position(b), position(c), target_) >= 0) {
            return {Kind::end, index, {}};
        }
        if (zeros == 0) {
            crossed_.push_back({index, slot});
            const Index neighbor = cell.neighbors[slot];
            return {mesh_.cells[neighbor].is_infinite() ? Kind::end : Kind::cell, neighbor, {}};
        }
        // Coplanar with one edge: leaves through its interior. With two: through their corner.
        const std::array<Index, 3> corners = {a, b, c};
        for (int i = 0; i < 3; ++i) {
            const Index from = corners[i];
            const Index to = corners[(i + 1) % 3];
            if (zeros == 1 && turns[i] == 0) {
                return {Kind::edge, index, {from, to, kInfinite}};
            }
            if (zeros == 2 && turns[i] == 0 && turns[(i + 1) % 3] == 0) {
                return {Kind::vertex, index, {to, kInfinite, kInfinite}};
            }
        }
    }
    return {Kind::end, index, {}}; // unreachable: a line through the interior leaves the cell
}

/// In a facet's plane: leaves corner 0 through the interior of the edge between corners 1 and 2.
ExactWalk::Position ExactWalk::leave_facet_from_vertex(const Position& place)
{
    const auto [from, a, b] = place.corners;
    const Index off = mesh_.cells[place.cell].vertices[off_plane_corner(place)];
    const int here = orientation(position(a), position(b), position(off), position(from));
    const int there = orientation(position(a), position(b), position(off), target_);
    if (there == here || there == 0) {
        return {Kind::end, place.cell, {}};
    }
    return {Kind::edge, place.cell, {a, b, kInfinite}};
}

/// In a facet's plane: leaves the interior of the edge between corners 0 and 1.
ExactWalk::Position ExactWalk::leave_facet_from_edge(const Position& place)
{
    const auto [a, b, tip] = place.corners;
    const Index off = mesh_.cells[place.cell].vertices[off_plane_corner(place)];
    // The plane through the line and `off` separates a and b. The ray leaves by the edge to the tip
    // from the corner on the other side of the plane.
    const int side_a = orientation(point_, target_, position(off), position(a));
    const int side_tip = orientation(point_, target_, position(off), position(tip));
    const Index far_end = side_tip == side_a ? b : a;
    const Index near_end = far_end == a ? b : a;
    const int here =
        orientation(position(far_end), position(tip), position(off), position(near_end));
    const int there = orientation(position(far_end), position(tip), position(off), target_);
    if (there == here || there == 0) {
        return {Kind::end, place.cell, {}};
    }
    if (side_tip == 0) {
        return {Kind::vertex, place.cell, {tip, kInfinite, kInfinite}};
    }
    return {Kind::edge, place.cell, {far_end, tip, kInfinite}};
}

/// In the interior of an edge: enters the cell or facet around the edge that faces the target.
ExactWalk::Position ExactWalk::leave_edge(const Position& place)
{
    const Index a = place.corners[0];
    const Index b = place.corners[1];
    for (const Index index : cells_around_edge(mesh_, a, b, place.cell)) {
        const Cell& cell = mesh_.cells[index];
        if (cell.is_infinite()) {
            continue;
        }
        std::array<Index, 2> others{};
        std::copy_if(cell.vertices.begin(), cell.vertices.end(), others.begin(),
                     [&](Index v) { return v != a && v != b; });
        const auto [x, y] = others;
        const int turn = orientation(position(a), position(b), position(x), position(y));
        const int beyond_x = orientation(position(a), position(b), position(x), target_) * turn;
        const int before_y = orientation(position(a), position(b), target_, position(y)) * turn;
        if (beyond_x > 0 && before_y > 0) {
            return {Kind::cell, index, {}};
        }
        if (beyond_x == 0 && before_y > 0) {
            return {Kind::facet_from_edge, index, {a, b, x}};
        }
        if (beyond_x > 0 && before_y == 0) {
            return {Kind::facet_from_edge, index, {a, b, y}};
        }
    }
    return {}; // leaves the hull
}

/// At a vertex: enters the cell, facet or edge around the vertex that leads to the target.
ExactWalk::Position ExactWalk::leave_vertex(const Position& place)
{
    const Index vertex = place.corners[0];
    if (target_is_vertex(vertex)) {
        return {Kind::end, place.cell, {}};
    }
    for (const Index index : cells_around_vertex(mesh_, vertex, place.cell)) {
        const Cell& cell = mesh_.cells[index];
        if (cell.is_infinite()) {
            continue;
        }
        const auto corners = facet_corners(cell, exact_slot_of(cell, vertex));
        std::array<int, 3> turns{};
        for (int i = 0; i < 3; ++i) {
            turns[i] = side_of_line(corners[i], corners[(i + 1) % 3]);
        }
        const auto zeros = std::count(turns.begin(), turns.end(), 0);
        if (std::count(turns.begin(), turns.end(), -1) > 0 || zeros == 3) {
            continue; // does not lead to the target
        }
        if (zeros == 0) {
            return {Kind::cell, index, {}};
        }
        for (int i = 0; i < 3; ++i) {
            const Index from = corners[i];
            const Index to = corners[(i + 1) % 3];
            if (zeros == 1 && turns[i] == 0) {
                return {Kind::facet_from_vertex, index, {vertex, from, to}};
            }
            if (zeros == 2 && turns[i] == 0 && turns[(i + 1) % 3] == 0) {
                const bool passes = lies_between(position(vertex), position(to), target_);
                return passes ? Position{Kind::vertex, index, {to, kInfinite, kInfinite}}
                              : Position{Kind::end, index, {}};
            }
        }
    }
    return {}; // leaves the hull
}

ExactWalk::Position ExactWalk::leave(const Position& place)
{
    switch (place.kind) {
    case Kind::cell:
        return leave_cell(place.cell);
    case Kind::facet_from_vertex:
        return leave_facet_from_vertex(place);
    case Kind::facet_from_edge:
        return leave_facet_from_edge(place);
    case Kind::edge:
        return leave_edge(place);
    case Kind::vertex:
        return leave_vertex(place);
    case Kind::end:
        break;
    }
    return place;
}

Index ExactWalk::follow(Position place)
{
    while (place.kind != Kind::end) {
        place = leave(place);
    }
    return place.cell;
}

Index ExactWalk::from_cell(Index cell)
{
    return follow({Kind::cell, cell, {}});
}

WalkEnds ExactWalk::from_vertex(Index vertex)
{
    const Position start{
        Kind::vertex, mesh_.cell_of_vertex[vertex], {vertex, kInfinite, kInfinite}};
    const Position first = leave(start);
    return {first.kind == Kind::cell ? first.cell : kInfinite, follow(first)};
}

} // namespace vcarve
