#pragma once

#include "steps/2_planes/plane_frame.h"

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

namespace vcarve {

/// A square of a grid, by its column and its row.
using Square = std::pair<std::int64_t, std::int64_t>;

/// The squares at the four sides of one.
inline std::array<Square, 4> squares_beside(const Square& square)
{
    const auto [column, row] = square;
    return {{{column - 1, row}, {column + 1, row}, {column, row - 1}, {column, row + 1}}};
}

/// A plane divided into squares.
class PlaneGrid {
  public:
    /// Squares whose sides have this length.
    PlaneGrid(const Plane& plane, double side) : frame_(plane), side_(side) {}

    double side() const { return side_; }
    const PlaneFrame& frame() const { return frame_; }

    /// Whether whole numbers tell the squares of all these places apart.
    bool can_number(const std::vector<Eigen::Vector3d>& places) const
    {
        constexpr double kMost = 1e15;
        return std::ranges::all_of(places, [&](const Eigen::Vector3d& place) {
            return frame_.in_plane(place).norm() < kMost * side_; // nor if it is no number
        });
    }
    Square square_of(const Eigen::Vector3d& place) const
    {
        const Eigen::Array2d steps = frame_.in_plane(place).array() / side_ + kShift;
        return {static_cast<std::int64_t>(std::floor(steps.x())),
                static_cast<std::int64_t>(std::floor(steps.y()))};
    }
    /// The place in a square that is so many sides from its lower left corner.
    Eigen::Vector3d place_in(const Square& square, double right, double up) const
    {
        const auto& [column, row] = square;
        return frame_.in_space({side_ * (static_cast<double>(column) + right - kShift),
                                side_ * (static_cast<double>(row) + up - kShift)});
    }
    std::array<Eigen::Vector3d, 4> corners_of(const Square& square) const
    {
        return {place_in(square, 0.0, 0.0), place_in(square, 1.0, 0.0), place_in(square, 1.0, 1.0),
                place_in(square, 0.0, 1.0)};
    }
    /// The square as two triangles.
    std::array<std::array<Eigen::Vector3d, 3>, 2> halves_of(const Square& square) const
    {
        const auto& [a, b, c, d] = corners_of(square);
        return {{{a, b, c}, {c, d, a}}};
    }

  private:
    /// The middle of the plane is no corner: points that stand in rows around it would be on the
    /// lines, and rounding would tell in which squares.
    static constexpr double kShift = 0.118;

    PlaneFrame frame_;
    double side_;
};

} // namespace vcarve
