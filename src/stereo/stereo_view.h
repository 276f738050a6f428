#pragma once

#include "io/images/calibrated_photo.h"
#include "model/photograph.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace vcarve {

/// The gray level of a pixel that shows nothing. Any sum with it is NaN too.
inline constexpr float kNoGray = std::numeric_limits<float>::quiet_NaN();

/// A gray image, 0 to 255 or kNoGray, row by row from the top. Pixel centers have integer
/// coordinates.
struct GrayImage {
    int width_px = 0;
    int height_px = 0;
    std::vector<float> pixels;

    float at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width_px + x]; }
};

/// Averages every 2 x 2 pixels to one, kNoGray if one is. Drops an odd last row or column.
GrayImage halved(const GrayImage& image);

/// A pinhole camera: u = focal x / z + principal.
struct Pinhole {
    float focal_px = 0.0F;
    Eigen::Vector2f principal_px = Eigen::Vector2f::Zero();

    /// The ray through a pixel, with z = 1, in the camera's frame.
    Eigen::Vector3f ray(float x, float y) const
    {
        return {(x - principal_px.x()) / focal_px, (y - principal_px.y()) / focal_px, 1.0F};
    }
};

/// The camera of the halved image.
Pinhole halved(const Pinhole& camera);

/// A photograph prepared for stereo: gray, at the working size, without lens distortion.
struct StereoView {
    std::uint32_t view = 0;                                       ///< index into Scene::views
    Eigen::Matrix3d cam_from_world = Eigen::Matrix3d::Identity(); ///< rotation
    Eigen::Vector3d center = Eigen::Vector3d::Zero();
    Pinhole camera;
    GrayImage image;           ///< kNoGray beyond the photograph and if transparent
    std::vector<Color> colors; ///< per pixel of the depth map
    std::string problem;       ///< error if the photograph is unreadable, else empty
};

/// Image pixels per pixel of a depth map, along a side.
inline constexpr int kDepthStep = 2;

/// The number of depth map pixels along a side of an image.
constexpr int depth_pixels(int image_px)
{
    return (image_px + kDepthStep - 1) / kDepthStep;
}

/// The ray through a pixel of a depth map.
inline Eigen::Vector3f depth_ray(const Pinhole& camera, int x, int y)
{
    return camera.ray(static_cast<float>(x * kDepthStep), static_cast<float>(y * kDepthStep));
}

/// Pixels of the working image per pixel of the photograph, along a side: at most 1.
double working_scale(const PhotographSize& photograph, int size_px);

/// The working camera of a photograph, and the size of its image.
StereoView view_without_pixels(const CalibratedPhoto& photo, int size_px);

/// Undistorts a photograph to a pinhole image, like COLMAP's image_undistorter. The longest side is
/// at most `size_px` and never longer than the photograph's. Each pixel is the mean of four samples
/// half a pixel apart, or one sample if it is not much larger than the photograph's. An unreadable
/// photograph gives an image of kNoGray. Cost: decoding, and four samples per pixel.
StereoView stereo_view(const CalibratedPhoto& photo, int size_px);

} // namespace vcarve
