#include "model/camera.h"

#include "model/lens.h"

#include <cmath>
#include <numbers>

namespace vcarve {
namespace {

using enum LensGeometry;

constexpr int kSkewedPinhole = 18;
constexpr double kRayTolerancePx = 1e-6;

bool within(double value_px, double size_px)
{
    return value_px >= 0.0 && value_px <= size_px;
}

/// The lens model of a camera; null if it is unknown or parameters are missing.
const LensModel* usable_lens(const Camera& camera)
{
    const LensModel* lens = lens_model(camera.model);
    return lens != nullptr && camera.params.size() >= lens->num_params ? lens : nullptr;
}

/// The parameters after the principal point.
const double* extra_params(const LensModel& lens, const Camera& camera)
{
    return camera.params.data() + lens.num_focals + 2;
}

Intrinsics intrinsics_of(const LensModel& lens, const Camera& camera)
{
    const std::size_t center = lens.num_focals;
    return {{camera.params[0], camera.params[center - 1]},
            {camera.params[center], camera.params[center + 1]},
            lens.number == kSkewedPinhole ? extra_params(lens, camera)[0] : 0.0};
}

/// `k` points to the parameters after the principal point.
LensDistortion perspective_distortion(int number, const double* k)
{
    LensDistortion result;
    switch (number) {
    case 2: // k
        result.radial = {k[0]};
        break;
    case 3: // k1, k2
        result.radial = {k[0], k[1]};
        break;
    case 4: // k1, k2, p1, p2
        result.radial = {k[0], k[1]};
        result.tangential = {k[3], k[2]};
        break;
    case 6: // k1, k2, p1, p2, k3, k4, k5, k6
        result.radial = {k[0], k[1], k[4]};
        result.divisor = {k[5], k[6], k[7]};
        result.tangential = {k[3], k[2]};
        result.divides = true;
        break;
    case 19: // k1, k2, k3, p1, p2
        result.radial = {k[0], k[1], k[2]};
        result.tangential = {k[4], k[3]};
        break;
    default:
        break;
    }
    return result;
}

LensDistortion fisheye_distortion(int number, const double* k)
{
    LensDistortion result;
    switch (number) {
    case 5: // k1, k2, k3, k4
        result.radial = {k[0], k[1], k[2], k[3]};
        break;
    case 8: // k
        result.radial = {k[0]};
        break;
    case 9: // k1, k2
        result.radial = {k[0], k[1]};
        break;
    case 10: // k1, k2, p1, p2, k3, k4, sx1, sy1
        result.radial = {k[0], k[1], k[4], k[5]};
        result.tangential = {k[3], k[2]};
        result.prism_s = {k[6], k[7]};
        break;
    case 11: // k0, ..., k5, p0, p1, s0, s1, s2, s3
        result.radial = {k[0], k[1], k[2], k[3], k[4], k[5]};
        result.tangential = {k[6], k[7]};
        result.prism_s = {k[8], k[10]};
        result.prism_ss = {k[9], k[11]};
        result.in_sequence = true;
        break;
    default:
        break;
    }
    return result;
}

/// The distortion of a polynomial lens.
LensDistortion distortion_of(const LensModel& lens, const Camera& camera)
{
    const double* k = extra_params(lens, camera);
    return lens.geometry == fisheye ? fisheye_distortion(lens.number, k)
                                    : perspective_distortion(lens.number, k);
}

// ---- from directions to the image plane at focal length 1, and back -----------------------------
// The functions take only the parameters of their lens. `radius` is the distance from the center of
// the plane.

std::optional<Eigen::Vector2d> fisheye_plane(const Eigen::Vector3d& x)
{
    const double radius = x.head<2>().norm();
    if (radius != 0.0) return x.head<2>() * (std::atan2(radius, x.z()) / radius);
    if (x.z() > 0.0) return Eigen::Vector2d::Zero();
    return std::nullopt;
}

std::optional<Eigen::Vector3d> fisheye_ray(const Eigen::Vector2d& point)
{
    const double angle = point.norm();
    if (angle > std::numbers::pi) return std::nullopt;
    const Eigen::Vector2d aside = angle > 0.0 ? point * (std::sin(angle) / angle) : point;
    return Eigen::Vector3d(aside.x(), aside.y(), std::cos(angle));
}

/// The distorted radius is atan(2 r tan(omega / 2)) / omega.
std::optional<Eigen::Vector2d> fov_plane(double omega, const Eigen::Vector3d& x)
{
    if (!(x.z() > 0.0) || !(std::abs(omega) < std::numbers::pi)) return std::nullopt;
    const Eigen::Vector2d ideal = x.head<2>() / x.z();
    const double radius = ideal.norm();
    if (omega == 0.0 || radius == 0.0) return ideal;
    return ideal * (std::atan(2.0 * radius * std::tan(omega / 2.0)) / (radius * omega));
}

std::optional<Eigen::Vector3d> fov_ray(double omega, const Eigen::Vector2d& point)
{
    const double radius = point.norm();
    if (omega == 0.0 || radius == 0.0) return Eigen::Vector3d(point.x(), point.y(), 1.0);
    const double angle = radius * std::abs(omega);
    if (!(angle < std::numbers::pi / 2.0)) return std::nullopt;
    const Eigen::Vector2d ideal =
        point * (std::tan(angle) / (2.0 * radius * std::tan(std::abs(omega) / 2.0)));
    return Eigen::Vector3d(ideal.x(), ideal.y(), 1.0);
}

/// The undistorted point is the point on the plane divided by 1 + k radius^2. Of the two solutions,
/// this returns the one that is continuous from the center.
std::optional<Eigen::Vector2d> division_plane(double k, const Eigen::Vector3d& x)
{
    const double discriminant = x.z() * x.z() - 4.0 * k * x.head<2>().squaredNorm();
    if (!(discriminant >= 0.0)) return std::nullopt;
    const double divisor = x.z() + std::sqrt(discriminant);
    if (!(divisor > 0.0)) return std::nullopt;
    return x.head<2>() * (2.0 / divisor);
}

/// The point on the plane is x / (alpha d + (1 - alpha) z), d^2 = beta (x^2 + y^2) + z^2. It is
/// not one-to-one in a cone around the backward axis, which widens as alpha departs from 1 / 2.
std::optional<Eigen::Vector2d> unified_plane(double alpha, double beta, const Eigen::Vector3d& x)
{
    const double d = std::sqrt(beta * x.head<2>().squaredNorm() + x.z() * x.z());
    const double divisor = alpha * d + (1.0 - alpha) * x.z();
    const bool one_to_one = alpha <= 0.5 || alpha * x.z() > -(1.0 - alpha) * d;
    if (!(divisor > 0.0) || !one_to_one) return std::nullopt;
    return x.head<2>() / divisor;
}

std::optional<Eigen::Vector3d> unified_ray(double alpha, double beta, const Eigen::Vector2d& point)
{
    const double s = beta * point.squaredNorm();
    const double root = 1.0 - (2.0 * alpha - 1.0) * s;
    if (!(root >= 0.0)) return std::nullopt;
    const double z = (1.0 - alpha * alpha * s) / (alpha * std::sqrt(root) + (1.0 - alpha));
    return Eigen::Vector3d(point.x(), point.y(), z);
}

std::optional<Eigen::Vector2d> to_plane(const LensModel& lens, const Camera& camera,
                                        const Eigen::Vector3d& x)
{
    switch (lens.geometry) {
    case fisheye:
        return fisheye_plane(x);
    case fov:
        return fov_plane(extra_params(lens, camera)[0], x);
    case division:
        return division_plane(extra_params(lens, camera)[0], x);
    case unified:
        return unified_plane(extra_params(lens, camera)[0], extra_params(lens, camera)[1], x);
    default:
        if (!(x.z() > 0.0)) return std::nullopt;
        return x.head<2>() / x.z();
    }
}

std::optional<Eigen::Vector3d> from_plane(const LensModel& lens, const Camera& camera,
                                          const Eigen::Vector2d& point)
{
    const double* extra = extra_params(lens, camera);
    switch (lens.geometry) {
    case fisheye:
        return fisheye_ray(point);
    case fov:
        return fov_ray(extra[0], point);
    case division:
        return Eigen::Vector3d(point.x(), point.y(), 1.0 + extra[0] * point.squaredNorm());
    case unified:
        return unified_ray(extra[0], extra[1], point);
    default:
        return Eigen::Vector3d(point.x(), point.y(), 1.0);
    }
}

// ---- longitude and latitude ---------------------------------------------------------------------

std::optional<Eigen::Vector2d> equirectangular_pixel(const Camera& camera, const Eigen::Vector3d& x)
{
    if (x.isZero(0.0)) return std::nullopt;
    const double longitude = std::atan2(x.x(), x.z());
    const double latitude = std::atan2(x.y(), std::hypot(x.x(), x.z())); // downwards
    return Eigen::Vector2d((longitude / (2.0 * std::numbers::pi) + 0.5) * camera.params[0],
                           (latitude / std::numbers::pi + 0.5) * camera.params[1]);
}

std::optional<Eigen::Vector3d> equirectangular_ray(const Camera& camera, const Eigen::Vector2d& px)
{
    const double width_px = camera.params[0];
    const double height_px = camera.params[1];
    if (!within(px.x(), width_px) || !within(px.y(), height_px)) return std::nullopt;
    const double longitude = 2.0 * std::numbers::pi * (px.x() / width_px - 0.5);
    const double latitude = std::numbers::pi * (px.y() / height_px - 0.5);
    return Eigen::Vector3d(std::cos(latitude) * std::sin(longitude), std::sin(latitude),
                           std::cos(latitude) * std::cos(longitude));
}

// ---- all lenses ---------------------------------------------------------------------------------

/// The projection of a direction: on the image plane before polynomial distortion, and in pixels.
struct Placed {
    Eigen::Vector2d on_plane;
    Eigen::Vector2d x_px;
};

/// Projects a direction. Does not check whether it is beyond the turn of the distortion.
std::optional<Placed> place(const LensModel& lens, const Camera& camera, const Eigen::Vector3d& x)
{
    if (lens.geometry == equirectangular) {
        const auto pixel = equirectangular_pixel(camera, x);
        if (!pixel || !pixel->allFinite()) return std::nullopt;
        return Placed{*pixel, *pixel};
    }
    const auto on_plane = to_plane(lens, camera, x);
    if (!on_plane) return std::nullopt;
    const Eigen::Vector2d moved =
        lens.polynomial ? distort(distortion_of(lens, camera), *on_plane) : *on_plane;
    const Intrinsics to_pixels = intrinsics_of(lens, camera);
    Eigen::Vector2d x_px = moved.cwiseProduct(to_pixels.focal_px) + to_pixels.principal_px;
    x_px.x() += to_pixels.skew_px * moved.y();
    if (!x_px.allFinite()) return std::nullopt;
    return Placed{*on_plane, x_px};
}

double mean_focal_px(const Camera& camera)
{
    const LensModel* lens = usable_lens(camera);
    if (lens != nullptr && lens->num_focals > 0)
        return intrinsics_of(*lens, camera).focal_px.mean();
    if (lens != nullptr && lens->geometry == equirectangular) {
        return camera.params[0] / (2.0 * std::numbers::pi);
    }
    return static_cast<double>(std::max(camera.width_px, camera.height_px));
}

bool turned(const LensModel& lens, const Camera& camera, const Placed& placed)
{
    return lens.polynomial && !before_turn(distortion_of(lens, camera), placed.on_plane);
}

} // namespace

std::optional<Intrinsics> intrinsics(const Camera& camera)
{
    const LensModel* lens = usable_lens(camera);
    if (lens == nullptr || lens->num_focals == 0) return std::nullopt;
    return intrinsics_of(*lens, camera);
}

std::vector<double> mean_focals_px(const std::vector<Camera>& cameras)
{
    std::vector<double> focals;
    focals.reserve(cameras.size());
    for (const Camera& camera : cameras) {
        focals.push_back(mean_focal_px(camera));
    }
    return focals;
}

std::optional<Eigen::Vector2d> project(const Camera& camera, const Eigen::Vector3d& x_in_cam)
{
    const LensModel* lens = usable_lens(camera);
    if (lens == nullptr) return std::nullopt;
    const auto placed = place(*lens, camera, x_in_cam);
    if (!placed || turned(*lens, camera, *placed)) return std::nullopt;
    return placed->x_px;
}

std::optional<Eigen::Vector3d> ray(const Camera& camera, const Eigen::Vector2d& x_px)
{
    const LensModel* lens = usable_lens(camera);
    if (lens == nullptr) return std::nullopt;
    if (lens->geometry == equirectangular) return equirectangular_ray(camera, x_px);
    const Intrinsics to_pixels = intrinsics_of(*lens, camera);
    Eigen::Vector2d point = (x_px - to_pixels.principal_px).cwiseQuotient(to_pixels.focal_px);
    point.x() -= to_pixels.skew_px * point.y() / to_pixels.focal_px.x();
    if (lens->polynomial) point = undistort(distortion_of(*lens, camera), point);
    auto direction = from_plane(*lens, camera, point);
    if (!direction) return std::nullopt;
    direction->normalize();
    const auto back_px = project(camera, *direction);
    if (!back_px || !((*back_px - x_px).norm() <= kRayTolerancePx)) return std::nullopt;
    return direction;
}

bool image_shows(const Camera& camera, const Eigen::Vector3d& x_in_cam)
{
    const LensModel* lens = usable_lens(camera);
    if (lens == nullptr || camera.width_px == 0 || camera.height_px == 0) return x_in_cam.z() > 0.0;
    const auto placed = place(*lens, camera, x_in_cam);
    if (!placed) return false;
    return within(placed->x_px.x(), static_cast<double>(camera.width_px)) &&
           within(placed->x_px.y(), static_cast<double>(camera.height_px)) &&
           !turned(*lens, camera, *placed);
}

bool view_shows(const View& view, const Camera& camera, const Eigen::Vector3d& x_in_world)
{
    return image_shows(camera, view.cam_from_world * (x_in_world - view.center));
}

} // namespace vcarve
