#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <array>
#include <cstdint>
#include <set>
#include <vector>

namespace vcarve::paper {

/// A position on the integer lattice of spacing 1 / kSpotsPerUnit. All predicates are exact in
/// 64-bit integers if coordinates are below 2^19.
using Spot = Eigen::Matrix<std::int64_t, 3, 1>;
inline constexpr std::int64_t kSpotsPerUnit = 2048;

/// Six times the signed volume of the tetrahedron a b c d.
std::int64_t volume_6(const Spot& a, const Spot& b, const Spot& c, const Spot& d);

struct Box {
    Spot low;
    Spot high;
};

/// An edge of the solid between two corners.
struct Edge {
    Spot begin;
    Spot end;
};

/// All faces of the solid in the plane where coordinate `axis` is `plane`, with the same outside.
struct Side {
    int axis = 0;
    std::int64_t plane = 0;
    bool outward_up = false; ///< whether the outside has larger coordinates

    // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 takes the defaulted comparison for a 0
    auto operator<=>(const Side&) const = default;
};

/// A union of axis-aligned boxes.
class BoxSolid {
  public:
    /// `bounds` holds x0 y0 z0 x1 y1 z1 of each box, in scene units.
    explicit BoxSolid(const std::vector<std::array<double, 6>>& bounds);

    const std::vector<Box>& boxes() const { return boxes_; }
    Spot low() const { return {ticks_[0].front(), ticks_[1].front(), ticks_[2].front()}; }
    Spot high() const { return {ticks_[0].back(), ticks_[1].back(), ticks_[2].back()}; }
    std::int64_t volume() const; ///< in cubed lattice spacings

    std::vector<Edge> edges() const;
    std::vector<Side> sides() const;
    /// Whether `sum` / 3 is on a face of `side`.
    bool on_side(const Side& side, const Spot& sum) const;

    /// Whether the segment, except its begin, does not touch the closed solid.
    bool sees(const Spot& begin, const Spot& end) const;
    /// Whether the interior of a tetrahedron meets the solid, and empty space.
    struct Meets {
        bool solid = false;
        bool empty = false;
    };
    Meets meets(const std::array<Spot, 4>& cell) const;

  private:
    using Index = Eigen::Vector3i;

    bool solid_at(const Index& index) const; ///< false beyond the grid
    bool is_edge(const Index& index, int axis) const;
    bool is_corner(const Index& index) const;
    Spot spot(const Index& index) const;

    std::vector<Box> boxes_;
    std::array<std::vector<std::int64_t>, 3> ticks_; ///< planes of the grid of all box sides
};

} // namespace vcarve::paper
