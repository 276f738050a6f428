#pragma once

#include "model/lens.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace vcarve {

/// From the image plane at focal length 1 to pixels: u = fx x + skew y + cx, v = fy y + cy.
struct Intrinsics {
    Eigen::Vector2d focal_px;
    Eigen::Vector2d principal_px;
    double skew_px = 0.0;
};

/// Nothing for a lens that is not known, has too few parameters, or has no focal length.
std::optional<Intrinsics> intrinsics(const Camera& camera);

/// Of each camera the mean of its two focal lengths in pixels; of a panorama the pixels a radian of
/// its horizon; the larger side of its images where the lens is not known.
std::vector<double> mean_focals_px(const std::vector<Camera>& cameras);

/// The pixel that shows a point given in the camera's frame (x right, y down, z forward), by the
/// exact formula of the lens. The image's upper left corner is (0, 0), the middle of its first
/// pixel (0.5, 0.5); whether the pixel lies in the image is not asked. Nothing for a lens that is
/// not known or has too few parameters, and where the lens shows no such direction: behind a
/// perspective lens, and from where its distortion turns back on (see before_turn). A fisheye, a
/// unified and a division lens show what lies behind them as far as their formulas stay one to one;
/// COLMAP leaves that out for the first two. Cost: as distort() and before_turn() for a polynomial
/// lens, some multiplications for others.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_in_cam);

/// The direction, a unit vector in the camera's frame, that project() brings to a pixel. Nothing
/// where project() has none within 1e-6 px of the pixel; an equirectangular image has one for every
/// pixel in it. Cost: some steps of Newton's method for a polynomial lens, closed form for others.
std::optional<Eigen::Vector3d> ray(const Camera& camera, const Eigen::Vector2d& x_px);

/// Whether project() brings a point into the image, its edges included. A camera whose lens is not
/// known, or that has too few parameters or no size, shows everything before it (z > 0). Cost: as
/// project(), and less for a point that is not shown.
bool image_shows(const Camera& camera, const Eigen::Vector3d& x_in_cam);

/// The same for a view and a point in the frame of the view's centre.
bool view_shows(const View& view, const Camera& camera, const Eigen::Vector3d& x_in_world);

} // namespace vcarve
