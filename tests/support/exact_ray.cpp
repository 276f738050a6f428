#include "support/exact_ray.h"

#include "geometry/predicates.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <fmt/core.h>

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Number = CGAL::Epeck::FT;

struct ExactTriangle {
    Vector3d a, b, c;
};

ExactTriangle triangle_of(const TetMesh& mesh, Index cell, int slot)
{
    const auto& vertices = mesh.cells[cell].vertices;
    const auto& corners = kFacetCorners[slot];
    return {mesh.positions[vertices[corners[0]]], mesh.positions[vertices[corners[1]]],
            mesh.positions[vertices[corners[2]]]};
}

int side(const ExactTriangle& t, const Vector3d& p)
{
    return orientation(t.a, t.b, t.c, p);
}

/// Whether the line through two points passes through the relative interior of a triangle.
bool pierces(const ExactTriangle& t, const Vector3d& from, const Vector3d& to)
{
    const int ab = orientation(from, to, t.a, t.b);
    return ab != 0 && orientation(from, to, t.b, t.c) == ab &&
           orientation(from, to, t.c, t.a) == ab;
}

/// Six times the volume of the tetrahedron over a triangle, exact.
Number volume_6(const ExactTriangle& t, const Vector3d& tip)
{
    std::array<std::array<Number, 3>, 3> m;
    const std::array<Vector3d, 3> corners = {t.a, t.b, t.c};
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            m[row][column] = Number(corners[row][column]) - Number(tip[column]);
        }
    }
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
}

/// The parameter, 0 at `from` and 1 at `to`, at which their line meets the plane of a triangle.
Number share_at(const ExactTriangle& t, const Vector3d& from, const Vector3d& to)
{
    const Number before = volume_6(t, from);
    return before / (before - volume_6(t, to));
}

bool is_at_vertex(const Cell& cell, Index vertex)
{
    return std::find(cell.vertices.begin(), cell.vertices.end(), vertex) != cell.vertices.end();
}

/// Whether the ray leaves the hull at its vertex through this infinite cell, without a crossing.
bool leaves_past(const TetMesh& mesh, Index vertex, const Vector3d& target, Index cell)
{
    return mesh.cells[cell].is_infinite() && is_at_vertex(mesh.cells[cell], vertex) &&
           side(triangle_of(mesh, cell, 3), target) > 0;
}

std::string fault_of_last(const TetMesh& mesh, Index vertex, const Vector3d& target,
                          const std::vector<RayCrossing>& expected, Index last)
{
    if (!is_outside_hull(mesh, target)) {
        const bool is_right =
            last != kInfinite && !mesh.cells[last].is_infinite() && holds(mesh, last, target);
        return is_right ? "" : fmt::format("last cell {} does not contain the target", last);
    }
    Index way_out = kInfinite;
    if (!expected.empty()) {
        const auto [cell, slot] = expected.back().facet;
        const Index beyond = mesh.cells[cell].neighbors[slot];
        way_out = mesh.cells[beyond].is_infinite() ? beyond : kInfinite;
    }
    const bool is_right = last == way_out || (expected.empty() && last != kInfinite &&
                                              leaves_past(mesh, vertex, target, last));
    return is_right ? "" : fmt::format("last cell {}, expected {} outside the hull", last, way_out);
}

} // namespace

bool holds(const TetMesh& mesh, Index cell, const Vector3d& point)
{
    for (int slot = 0; slot < 4; ++slot) {
        if (side(triangle_of(mesh, cell, slot), point) < 0) {
            return false;
        }
    }
    return true;
}

bool is_outside_hull(const TetMesh& mesh, const Vector3d& point)
{
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (mesh.cells[cell].is_infinite() && side(triangle_of(mesh, cell, 3), point) > 0) {
            return true;
        }
    }
    return false;
}

std::vector<RayCrossing> crossings_by_brute_force(const TetMesh& mesh, Index vertex,
                                                  const Vector3d& target)
{
    const Vector3d& point = mesh.positions[vertex];
    std::vector<std::pair<Number, CellFacet>> found;
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && !mesh.cells[cell].is_infinite(); ++slot) {
            const ExactTriangle triangle = triangle_of(mesh, cell, slot);
            if (side(triangle, point) > 0 && side(triangle, target) < 0 &&
                pierces(triangle, point, target)) {
                found.push_back({share_at(triangle, point, target), {cell, slot}});
            }
        }
    }
    std::sort(found.begin(), found.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<RayCrossing> crossings;
    for (const auto& [share, crossed] : found) {
        crossings.push_back({crossed, CGAL::to_double(share)});
    }
    return crossings;
}

std::vector<CellFacet> crossings_by_brute_force(const TetMesh& mesh, const CellFacet& facet,
                                                const Vector3d& place, const Vector3d& target)
{
    const ExactTriangle start = triangle_of(mesh, facet.cell, facet.slot);
    if (!pierces(start, place, target) || orientation(place, target, start.a, start.b) > 0) {
        return {};
    }
    const Number begin = share_at(start, place, target);
    std::vector<std::pair<Number, CellFacet>> found{{begin, facet}};
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        for (int slot = 0; slot < 4 && !mesh.cells[cell].is_infinite(); ++slot) {
            const ExactTriangle triangle = triangle_of(mesh, cell, slot);
            if (side(triangle, target) < 0 && pierces(triangle, place, target)) {
                const Number share = share_at(triangle, place, target);
                const bool leads_out = orientation(place, target, triangle.a, triangle.b) < 0;
                if (leads_out && share > begin) found.push_back({share, {cell, slot}});
            }
        }
    }
    std::ranges::sort(found, {}, [](const auto& crossing) { return crossing.first; });
    std::vector<CellFacet> crossings;
    crossings.reserve(found.size());
    for (const auto& [share, crossed] : found) {
        crossings.push_back(crossed);
    }
    return crossings;
}

Index first_cell_by_brute_force(const TetMesh& mesh, Index vertex, const Vector3d& target)
{
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        const auto& vertices = mesh.cells[cell].vertices;
        bool enters = !mesh.cells[cell].is_infinite() && is_at_vertex(mesh.cells[cell], vertex);
        for (int slot = 0; slot < 4 && enters; ++slot) {
            enters = vertices[slot] == vertex || side(triangle_of(mesh, cell, slot), target) > 0;
        }
        if (enters) {
            return cell;
        }
    }
    return kInfinite;
}

std::string fault_of_walk(const TetMesh& mesh, Index vertex, const Vector3d& target,
                          const std::vector<CellFacet>& crossed, const WalkEnds& ends)
{
    const auto expected = crossings_by_brute_force(mesh, vertex, target);
    const bool same = std::equal(crossed.begin(), crossed.end(), expected.begin(), expected.end(),
                                 [](const CellFacet& a, const RayCrossing& b) {
                                     return a.cell == b.facet.cell && a.slot == b.facet.slot;
                                 });
    if (!same) {
        return fmt::format("{} crossed facets differ from the {} expected ones", crossed.size(),
                           expected.size());
    }
    const Index first = first_cell_by_brute_force(mesh, vertex, target);
    if (ends.first != first) {
        return fmt::format("first cell {}, expected {}", ends.first, first);
    }
    return fault_of_last(mesh, vertex, target, expected, ends.last);
}

} // namespace vcarve
