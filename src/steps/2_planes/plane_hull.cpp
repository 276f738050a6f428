#include "steps/2_planes/plane_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vcarve {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_2;

Point point(const Vector2d& place)
{
    return {place.x(), place.y()};
}

} // namespace

PlaneHull::PlaneHull(const std::vector<Vector3d>& places, const PlaneFrame& frame) : frame_(frame)
{
    std::vector<Point> all(places.size());
    std::ranges::transform(places, all.begin(),
                           [&](const Vector3d& place) { return point(frame.in_plane(place)); });
    std::vector<Point> corners;
    CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(corners));
    std::ranges::transform(corners, std::back_inserter(corners_),
                           [](const Point& corner) { return Vector2d(corner.x(), corner.y()); });
}

bool PlaneHull::contains(const Vector3d& place) const
{
    if (corners_.size() < 3) return false;
    const Point at = point(frame_.in_plane(place));
    const Point first = point(corners_.front());
    // The first of the corners to whose right the place lies, as seen from the first one.
    const auto next =
        std::partition_point(corners_.begin() + 1, corners_.end(), [&](const Vector2d& corner) {
            return CGAL::orientation(first, point(corner), at) != CGAL::RIGHT_TURN;
        });
    if (next == corners_.begin() + 1) return false;
    const Point last = point(*(next - 1));
    if (next == corners_.end()) { // on the last side, or beyond it
        return CGAL::collinear(first, at, last) &&
               CGAL::collinear_are_ordered_along_line(first, at, last);
    }
    return CGAL::orientation(last, point(*next), at) != CGAL::RIGHT_TURN;
}

std::vector<std::array<Vector3d, 3>> PlaneHull::triangles() const
{
    std::vector<std::array<Vector3d, 3>> fan;
    for (std::size_t i = 2; i < corners_.size(); ++i) {
        fan.push_back({frame_.in_space(corners_[0]), frame_.in_space(corners_[i - 1]),
                       frame_.in_space(corners_[i])});
    }
    return fan;
}

} // namespace vcarve
