#include "compare/image_field.h"

#include <array>
#include <cmath>

namespace vcarve {
namespace {

/// What the first parameters of a COLMAP camera model mean.
struct Lens {
    bool two_focals;
    bool fisheye;
    bool distorts;
};

/// By COLMAP's number of the model; its focal length(s) come first, then the principal point.
constexpr std::array<Lens, 12> kLenses = {{
    {false, false, false}, // SIMPLE_PINHOLE
    {true, false, false},  // PINHOLE
    {false, false, true},  // SIMPLE_RADIAL
    {false, false, true},  // RADIAL
    {true, false, true},   // OPENCV
    {true, true, true},    // OPENCV_FISHEYE
    {true, false, true},   // FULL_OPENCV
    {true, true, true},    // FOV
    {false, true, true},   // SIMPLE_RADIAL_FISHEYE
    {false, true, true},   // RADIAL_FISHEYE
    {true, true, true},    // THIN_PRISM_FISHEYE
    {true, true, true},    // RAD_TAN_THIN_PRISM_FISHEYE
}};

constexpr double kDistortionMargin = 0.1; ///< of the image's size

bool within(double value_px, std::uint64_t size_px, double margin)
{
    const auto size = static_cast<double>(size_px);
    return value_px >= -margin * size && value_px <= (1.0 + margin) * size;
}

/// Where a point lies on the image plane at focal length 1: tan of its angle to the axis, or the
/// angle itself for a fisheye.
Eigen::Vector2d image_plane_position(const Lens& lens, const Eigen::Vector3d& x_in_cam)
{
    if (!lens.fisheye) return x_in_cam.head<2>() / x_in_cam.z();
    const double radius = x_in_cam.head<2>().norm();
    if (radius == 0.0) return Eigen::Vector2d::Zero();
    return x_in_cam.head<2>() * (std::atan2(radius, x_in_cam.z()) / radius);
}

} // namespace

bool image_shows(const Camera& camera, const Eigen::Vector3d& x_in_cam)
{
    const bool known = camera.model >= 0 && camera.model < static_cast<int>(kLenses.size());
    const Lens lens = known ? kLenses[static_cast<std::size_t>(camera.model)] : Lens{};
    const std::size_t center = lens.two_focals ? 2 : 1;
    if (!lens.fisheye && !(x_in_cam.z() > 0.0)) return false;
    const bool sized = camera.width_px > 0 && camera.height_px > 0;
    if (!known || !sized || camera.params.size() < center + 2) return x_in_cam.z() > 0.0;

    const Eigen::Vector2d focal_px(camera.params[0], camera.params[center - 1]);
    const Eigen::Vector2d center_px(camera.params[center], camera.params[center + 1]);
    const Eigen::Vector2d x_px =
        image_plane_position(lens, x_in_cam).cwiseProduct(focal_px) + center_px;
    const double margin = lens.distorts ? kDistortionMargin : 0.0;
    return within(x_px.x(), camera.width_px, margin) && within(x_px.y(), camera.height_px, margin);
}

bool view_shows(const View& view, const Camera& camera, const Eigen::Vector3d& x_in_world)
{
    return image_shows(camera, view.cam_from_world * (x_in_world - view.center));
}

} // namespace vcarve
