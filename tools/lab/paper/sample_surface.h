#pragma once

#include "paper/box_solid.h"

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

namespace vcarve::paper {

/// Points on the surface of a solid: its corners, and as many more that no ball on an edge between
/// neighbours or around a triangle of a face holds another point and no triangle is larger than
/// `max_radius` (Shewchuk, "Tetrahedral mesh generation by Delaunay refinement", 1998; all angles
/// of a solid of boxes are right, so it ends). New points are jittered to keep clear of common
/// spheres.
std::vector<Spot> sample_surface(const BoxSolid& solid, std::int64_t max_radius,
                                 std::mt19937_64& random);

/// The Delaunay triangulation of the samples, cells told apart by the solid.
struct Cells {
    std::vector<std::array<std::uint32_t, 4>> solid;
    std::vector<std::array<std::uint32_t, 4>> empty;
    std::vector<std::array<std::uint32_t, 3>> boundary; ///< counter-clockwise seen from outside
};

/// Nothing if a cell lies on both sides of the solid's surface, or five samples lie on a sphere
/// that holds no other, so that the triangulation is not the only one.
std::optional<Cells> triangulate(const BoxSolid& solid, const std::vector<Spot>& samples);

} // namespace vcarve::paper
