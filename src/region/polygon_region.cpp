#include "geometry/cgal_kernel.h"
#include "io/colmap/text_reader.h"
#include "io/files/mapped_file.h"
#include "region/region.h"
#include "vcarve/error.h"

#include <CGAL/Polygon_2_algorithms.h>
#include <CGAL/intersections.h>
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using Point = Kernel::Point_2;

Point seen_from_above(const Vector3d& place)
{
    return {place.x(), place.y()};
}

class PolygonRegion final : public Region {
  public:
    explicit PolygonRegion(std::vector<Point> corners) : corners_(std::move(corners))
    {
        constexpr double kEndless = std::numeric_limits<double>::infinity();
        for (const Point& corner : corners_) {
            bounds_.extend(Vector3d(corner.x(), corner.y(), -kEndless));
            bounds_.extend(Vector3d(corner.x(), corner.y(), kEndless));
        }
    }

    bool contains(const Vector3d& place) const override
    {
        return bounds_.contains(place) &&
               CGAL::bounded_side_2(corners_.begin(), corners_.end(), seen_from_above(place),
                                    Kernel()) != CGAL::ON_UNBOUNDED_SIDE;
    }
    bool meets(const Vector3d& from, const Vector3d& to) const override
    {
        if (contains(from)) return true;
        const Kernel::Segment_2 way(seen_from_above(from), seen_from_above(to));
        if (way.is_degenerate()) return false; // vertical, and outside the polygon
        for (std::size_t i = 0; i < corners_.size(); ++i) {
            const Point& next = corners_[(i + 1) % corners_.size()];
            if (CGAL::do_intersect(way, Kernel::Segment_2(corners_[i], next))) return true;
        }
        return false;
    }
    Eigen::AlignedBox3d bounds() const override { return bounds_; }

  private:
    std::vector<Point> corners_;
    Eigen::AlignedBox3d bounds_;
};

double read_coordinate(TextReader& reader, const char* what)
{
    const double value = reader.read_double(what);
    if (!std::isfinite(value)) {
        reader.fail(fmt::format("found {}, expected {} (a finite number)", value, what));
    }
    return value;
}

std::vector<Point> read_corners(const std::filesystem::path& path)
{
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    std::vector<Point> corners;
    while (reader.next_record()) {
        const double x = read_coordinate(reader, "the x of a corner");
        const double y = read_coordinate(reader, "the y of a corner");
        if (!reader.at_line_end()) {
            reader.fail(fmt::format("found '{}' after the x and y of a corner, expected the end "
                                    "of the line",
                                    printable(reader.rest())));
        }
        corners.emplace_back(x, y);
    }
    if (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
    return corners;
}

} // namespace

std::unique_ptr<Region> read_polygon_region(const std::filesystem::path& path,
                                            const Vector3d& offset)
{
    std::vector<Point> corners = read_corners(path);
    if (corners.size() < 3) {
        throw InputError(fmt::format("{}: found {} corners of a polygon, expected at least 3",
                                     path.string(), corners.size()));
    }
    if (!CGAL::is_simple_2(corners.begin(), corners.end(), Kernel())) {
        throw InputError(fmt::format("{}: found a polygon that touches or intersects itself, "
                                     "expected a simple polygon",
                                     path.string()));
    }
    for (Point& corner : corners) {
        corner = Point(corner.x() - offset.x(), corner.y() - offset.y());
    }
    return std::make_unique<PolygonRegion>(std::move(corners));
}

} // namespace vcarve
