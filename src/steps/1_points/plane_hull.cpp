#include "steps/1_points/plane_hull.h"

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/convex_hull_2.h>

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
    return CGAL::bounded_side_2(corners_.begin(), corners_.end(), in_plane(place), Kernel()) !=
           CGAL::ON_UNBOUNDED_SIDE;
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
