#include "texture/calibrated_photo.h"

#include "model/camera.h"

namespace vcarve {

std::optional<Eigen::Vector2d> pixel_beyond(const CalibratedPhoto& photo,
                                            const Eigen::Vector3d& position)
{
    const Eigen::Vector3d in_cam = photo.pose.cam_from_world * (position - photo.pose.center);
    std::optional<Eigen::Vector2d> pixel = project(photo.camera, in_cam);
    if (pixel) pixel->array() *= photo.scale;
    return pixel;
}

std::optional<Eigen::Vector2d> pixel_of(const CalibratedPhoto& photo,
                                        const Eigen::Vector3d& position)
{
    const std::optional<Eigen::Vector2d> pixel = pixel_beyond(photo, position);
    const bool is_inside = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 &&
                           pixel->x() <= photo.size.width_px && pixel->y() <= photo.size.height_px;
    return is_inside ? pixel : std::nullopt;
}

} // namespace vcarve
