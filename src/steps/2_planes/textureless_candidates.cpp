#include "base/parallel.h"
#include "geometry/cgal_kernel.h"
#include "steps/2_planes/candidates.h"
#include "steps/2_planes/planar_regions.h"

#include <CGAL/Polygon_2_algorithms.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <set>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// A square of a grid: its column and row.
using Square = std::pair<std::int64_t, std::int64_t>;

/// The plane of a region, divided into squares.
class Grid {
  public:
    Grid(const PlanarRegion& region, double step)
        : region_(region), frame_(region.plane), side_(step * region.spacing)
    {
    }

    /// Whether doubles represent the square numbers of all points exactly.
    bool can_number_points() const
    {
        constexpr double kMost = 1e15;
        return std::ranges::all_of(region_.positions, [&](const Vector3d& place) {
            return frame_.in_plane(place).norm() < kMost * side_; // false for NaN, too
        });
    }

    /// The squares within the hull and without points, ring by ring around squares with points. At
    /// most as many as points.
    std::vector<Square> empty_squares() const
    {
        std::vector<Kernel::Point_2> hull;
        for (const Vector3d& corner : region_.hull()) {
            hull.push_back(in_plane(corner));
        }
        if (hull.size() < 3) return {};
        const auto is_within = [&](const Square& square) {
            return std::ranges::all_of(corners_of(square), [&](const Vector3d& corner) {
                return CGAL::bounded_side_2(hull.begin(), hull.end(), in_plane(corner), Kernel()) !=
                       CGAL::ON_UNBOUNDED_SIDE;
            });
        };
        std::set<Square> reached;
        for (const Vector3d& position : region_.positions) {
            reached.insert(square_of(position));
        }
        std::vector<Square> found(reached.begin(), reached.end());
        const std::size_t with_points = found.size();
        for (std::size_t i = 0; i < found.size(); ++i) {
            const auto [column, row] = found[i];
            for (const Square& beside : {Square(column - 1, row), Square(column + 1, row),
                                         Square(column, row - 1), Square(column, row + 1)}) {
                if (found.size() == with_points + region_.points.size()) break;
                if (reached.insert(beside).second && is_within(beside)) found.push_back(beside);
            }
        }
        found.erase(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(with_points));
        return found;
    }

    Candidate candidate_in(const Square& square, std::uint32_t number) const
    {
        const auto [a, b, c, d] = corners_of(square);
        return {.position = place_in(square),
                .kind = PointKind::textureless,
                .step = side_,
                .regions = {number, number},
                .surface = {{a, b, c}, {c, d, a}}};
    }

  private:
    Kernel::Point_2 in_plane(const Vector3d& place) const
    {
        const Eigen::Vector2d at = frame_.in_plane(place);
        return {at.x(), at.y()};
    }

    Square square_of(const Vector3d& place) const
    {
        const Eigen::Array2d steps = frame_.in_plane(place).array() / side_ + kShift;
        return {static_cast<std::int64_t>(std::floor(steps.x())),
                static_cast<std::int64_t>(std::floor(steps.y()))};
    }

    /// The position `right` and `up` sides from the lower left corner of a square.
    Vector3d at(const Square& square, double right, double up) const
    {
        const auto& [column, row] = square;
        return frame_.in_space({side_ * (static_cast<double>(column) + right - kShift),
                                side_ * (static_cast<double>(row) + up - kShift)});
    }

    std::array<Vector3d, 4> corners_of(const Square& square) const
    {
        return {at(square, 0.0, 0.0), at(square, 1.0, 0.0), at(square, 1.0, 1.0),
                at(square, 0.0, 1.0)};
    }

    /// The position of a candidate: near the center of its square and slightly off the plane, by
    /// pseudorandom amounts of the square's numbers.
    Vector3d place_in(const Square& square) const
    {
        constexpr double kAside = 0.1; // of a side, at most
        const auto column = static_cast<double>(square.first);
        const auto row = static_cast<double>(square.second);
        const auto turned = [&](double a, double b, double c) {
            const double turns = a * column * column + b * row * row + c * column * row;
            return 2.0 * (turns - std::floor(turns)) - 1.0;
        };
        const double right = turned(0.6180339887, 0.4142135624, 0.7320508076);
        const double up = turned(0.2360679775, 0.6457513111, 0.3166247904);
        const double off = turned(0.1622776602, 0.8729833462, 0.5825756950);
        return at(square, 0.5 + kAside * right, 0.5 + kAside * up) +
               kOffPlane * side_ * off * region_.plane.normal;
    }

    /// Shifts the grid from the center of the plane. Otherwise points in rows around the center
    /// would lie on grid lines, and rounding would select their squares.
    static constexpr double kShift = 0.118;

    const PlanarRegion& region_;
    PlaneFrame frame_;
    double side_;
};

} // namespace

std::vector<Candidate> textureless_candidates(const PlanarRegions& planes, double step,
                                              const Progress& progress)
{
    constexpr std::size_t kFewest = 100;
    const auto look = [&](std::size_t i, std::vector<Candidate>& found) {
        const PlanarRegion& region = planes.regions[i];
        if (region.points.size() < kFewest) return;
        const Grid grid(region, step);
        if (!grid.can_number_points()) return;
        for (const Square& square : grid.empty_squares()) {
            found.push_back(grid.candidate_in(square, static_cast<std::uint32_t>(i)));
        }
    };
    return parallel_collect<Candidate>(planes.regions.size(), progress, look, 1);
}

} // namespace vcarve
