#include "region/region.h"

#include "base/text.h"
#include "geometry/cgal_kernel.h"

#include <CGAL/intersections.h>

namespace vcarve {

namespace {

using Eigen::Vector3d;

class BoxRegion final : public Region {
  public:
    explicit BoxRegion(const Eigen::AlignedBox3d& box)
        : box_(box), cuboid_(to_cgal(box.min()), to_cgal(box.max()))
    {
    }

    bool contains(const Vector3d& place) const override { return box_.contains(place); }
    bool meets(const Vector3d& from, const Vector3d& to) const override
    {
        if (from == to) return contains(from);
        return CGAL::do_intersect(cuboid_, Kernel::Segment_3(to_cgal(from), to_cgal(to)));
    }
    Eigen::AlignedBox3d bounds() const override { return box_; }

  private:
    Eigen::AlignedBox3d box_;
    Kernel::Iso_cuboid_3 cuboid_;
};

class BallRegion final : public Region {
  public:
    explicit BallRegion(const Ball& ball) : ball_(ball) {}

    bool contains(const Vector3d& place) const override
    {
        return (place - ball_.center).norm() <= ball_.radius;
    }
    bool meets(const Vector3d& from, const Vector3d& to) const override
    {
        const Vector3d way = to - from;
        const double length_sq = way.squaredNorm();
        const double along = length_sq > 0.0 ? way.dot(ball_.center - from) / length_sq : 0.0;
        return contains(from + std::clamp(along, 0.0, 1.0) * way);
    }
    Eigen::AlignedBox3d bounds() const override
    {
        return {ball_.center.array() - ball_.radius, ball_.center.array() + ball_.radius};
    }

  private:
    Ball ball_;
};

} // namespace

std::unique_ptr<Region> make_region(const RegionChoice& choice, const Scene& scene)
{
    const bool is_ball = choice.kind == RegionChoice::Kind::looked_at;
    return make_region(choice, scene.offset, is_ball ? region_of_interest(scene) : Ball());
}

std::unique_ptr<Region> make_region(const RegionChoice& choice, const Vector3d& offset,
                                    const Ball& of_interest)
{
    switch (choice.kind) {
    case RegionChoice::Kind::everything:
        return nullptr;
    case RegionChoice::Kind::looked_at:
        return std::make_unique<BallRegion>(of_interest);
    case RegionChoice::Kind::box:
        return std::make_unique<BoxRegion>(
            Eigen::AlignedBox3d(choice.low - offset, choice.high - offset));
    case RegionChoice::Kind::file:
        break;
    }
    if (lower_case_end(choice.file) == ".ply") return read_mesh_region(choice.file, offset);
    return read_polygon_region(choice.file, offset);
}

} // namespace vcarve
