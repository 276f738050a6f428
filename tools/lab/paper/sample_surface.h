#pragma once

#include "paper/box_solid.h"

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace vcarve::paper {

/// Points on the surface of a solid: its corners, and refinement points. They are added until no
/// ball of an edge or triangle contains another point, and no triangle is larger than `max_radius`
/// (Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", 1998). This terminates because
/// all angles of boxes are right. New points are jittered to avoid cospherical points.
std::vector<Spot> sample_surface(const BoxSolid& solid, std::int64_t max_radius,
                                 std::mt19937_64& random);

/// The Delaunay triangulation of the samples, with cells classified by the solid.
struct Cells {
    std::vector<std::array<std::uint32_t, 4>> solid;
    std::vector<std::array<std::uint32_t, 4>> empty;
    std::vector<std::array<std::uint32_t, 3>> boundary; ///< counterclockwise from outside
};

/// Returns nothing if a cell is on both sides of the solid's surface, or if five samples are on an
/// empty sphere, because the triangulation is then not unique.
std::optional<Cells> triangulate(const BoxSolid& solid, const std::vector<Spot>& samples);

} // namespace vcarve::paper
