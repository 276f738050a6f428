#include "steps/1_points/plane_hull.h"

#include <CGAL/convex_hull_2.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace vcarve {

using Eigen::Vector3d;

PlaneHull::PlaneHull(const std::vector<Vector3d>& places, const PlaneFrame& frame) : frame_(frame)
{
    std::vector<Kernel::Point_2> all(places.size());
    std::ranges::transform(places, all.begin(),
                           [&](const Vector3d& place) { return in_plane(place); });
    CGAL::convex_hull_2(all.begin(), all.end(), std::back_inserter(corners_));
}

PlaneHull::Kernel::Point_2 PlaneHull::in_plane(const Vector3d& place) const
{
    const Eigen::Vector2d at = frame_.in_plane(place);
    return {at.x(), at.y()};
}

Vector3d PlaneHull::in_space(const Kernel::Point_2& at) const
{
    return frame_.in_space({at.x(), at.y()});
}

bool PlaneHull::contains(const Vector3d& place) const
{
    if (corners_.size() < 3) return false;
    const Kernel::Point_2 at = in_plane(place);
    const auto is_left_of = [&](const Kernel::Point_2& from, const Kernel::Point_2& to) {
        return CGAL::orientation(from, to, at) != CGAL::RIGHT_TURN;
    };
    // The last corner to whose left the place lies, as seen from the first one.
    const auto next = std::partition_point(
        corners_.begin() + 1, corners_.end(),
        [&](const Kernel::Point_2& corner) { return is_left_of(corners_.front(), corner); });
    if (next == corners_.begin() + 1) return false;
    if (next == corners_.end()) { // on the last side, or beyond it
        return CGAL::collinear(corners_.front(), at, corners_.back()) &&
               CGAL::collinear_are_ordered_along_line(corners_.front(), at, corners_.back());
    }
    return is_left_of(*(next - 1), *next);
}

std::vector<std::array<Vector3d, 3>> PlaneHull::triangles() const
{
    std::vector<std::array<Vector3d, 3>> fan;
    for (std::size_t i = 2; i < corners_.size(); ++i) {
        fan.push_back({in_space(corners_[0]), in_space(corners_[i - 1]), in_space(corners_[i])});
    }
    return fan;
}

} // namespace vcarve
