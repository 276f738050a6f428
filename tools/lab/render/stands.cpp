#include "render/stands.h"

#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace vcarve::render {

Pinhole looking_at(const Lens& lens, const Eigen::Vector3d& center, const Eigen::Vector3d& target)
{
    Pinhole view;
    view.center = center;
    view.focal_px.setConstant(lens.focal_px);
    view.principal_px = {lens.width_px / 2.0, lens.height_px / 2.0};
    view.width_px = lens.width_px;
    view.height_px = lens.height_px;
    const Eigen::Vector3d ahead = (target - center).normalized();
    const Eigen::Vector3d right = ahead.cross(Eigen::Vector3d::UnitZ()).normalized();
    view.cam_from_world << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
    return view;
}

void add_arc(std::vector<Pinhole>& views, const Lens& lens, const Arc& arc)
{
    for (int i = 0; i < arc.count; ++i) {
        const double turn_rad = (arc.first_deg + arc.step_deg * i) * std::numbers::pi / 180.0;
        const Eigen::Vector3d center(arc.target.x() + arc.radius * std::sin(turn_rad),
                                     arc.target.y() - arc.radius * std::cos(turn_rad), arc.height);
        views.push_back(looking_at(lens, center, arc.target));
    }
}

} // namespace vcarve::render
