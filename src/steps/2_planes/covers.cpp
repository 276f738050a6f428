#include "steps/2_planes/covers.h"

#include "steps/2_planes/plane_hull.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <iterator>

namespace vcarve {

using Eigen::Vector3d;

Covers::Covers(const FlatParts& parts) : parts_(parts)
{
    std::vector<std::array<Vector3d, 3>> triangles;
    Eigen::AlignedBox3d box;
    for (std::uint32_t part = 0; part < parts.patches.size(); ++part) {
        const Patch& patch = parts.patches[part];
        const PlaneHull hull(patch.positions, PlaneFrame(patch.region->plane));
        std::ranges::copy(hull.triangles(), std::back_inserter(triangles));
        owners_.resize(triangles.size(), part);
        for (const Vector3d& position : patch.positions) {
            box.extend(position);
        }
    }
    if (!box.isEmpty()) reach_ = 2.0 * box.diagonal().norm();
    tree_ = std::make_unique<TriangleTree>(triangles);
}

std::vector<std::uint32_t> Covers::over(const Vector3d& place, const Vector3d& way,
                                        double from) const
{
    std::vector<std::uint32_t> met;
    if (reach_ <= from) return met;
    tree_->visit_met(place + from * way, place + reach_ * way, [&](std::size_t triangle) {
        const std::uint32_t part = owners_[triangle];
        if (parts_.patches[part].region->plane.normal.dot(way) > 0.0) met.push_back(part);
    });
    return met;
}

} // namespace vcarve
