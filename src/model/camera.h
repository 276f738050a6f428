#pragma once

#include "model/lens.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace vcarve {

/// The map from the image plane at focal length 1 to pixels: u = fx x + skew y + cx, v = fy y + cy.
struct Intrinsics {
    Eigen::Vector2d focal_px;
    Eigen::Vector2d principal_px;
    double skew_px = 0.0;
};

/// The intrinsics, unless the lens is unknown, lacks parameters, or has no focal length.
std::optional<Intrinsics> intrinsics(const Camera& camera);

/// The mean of the two focal lengths of each camera, in pixels. For panoramas: pixels per radian of
/// the horizon. For unknown lenses: the larger side of the image.
std::vector<double> mean_focals_px(const std::vector<Camera>& cameras);

/// Projects a point in the camera's frame (x right, y down, z forward) with the exact formula of
/// the lens. Returns pixels: the image's upper left corner is (0, 0), the center of its first pixel
/// (0.5, 0.5). The pixel may be outside the image. Returns nothing if the lens is unknown, lacks
/// parameters, or does not show the direction: behind a perspective lens, and beyond the turn of
/// its distortion (see before_turn). Fisheye, unified and division lenses show points behind them
/// where their formulas are one-to-one; COLMAP rejects these points for the first two. Cost: as
/// distort() and before_turn() for a polynomial lens, a few multiplications for others.
std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_in_cam);

/// The inverse of project(): the direction of a pixel, a unit vector in the camera's frame. Returns
/// nothing if project() does not return the pixel within 1e-6 px. In an equirectangular image,
/// every pixel has a direction. Cost: a few Newton steps for a polynomial lens, closed form for
/// others.
std::optional<Eigen::Vector3d> ray(const Camera& camera, const Eigen::Vector2d& x_px);

/// Whether project() maps a point into the image or onto its edges. If the lens is unknown, or
/// parameters or the image size are missing: whether z > 0. Cost: at most that of project().
bool image_shows(const Camera& camera, const Eigen::Vector3d& x_in_cam);

/// The same for a view and a point in the frame of View::center.
bool view_shows(const View& view, const Camera& camera, const Eigen::Vector3d& x_in_world);

} // namespace vcarve
