#include "stereo/stereo_view.h"

#include "model/camera.h"
#include "model/colors.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace vcarve {

namespace {

/// Samples a photograph through its lens at pixels of the pinhole image.
class Undistorter {
  public:
    Undistorter(const CalibratedPhoto& photo, const Pinhole& camera, double width_px,
                std::string& problem)
        : photo_(photo),
          camera_(camera),
          width_px_(width_px),
          pyramid_(photograph_of(photo, problem))
    {
    }

    /// Returns nothing outside the photograph, or if it is transparent there.
    std::optional<Eigen::Array3f> at(float x, float y) const
    {
        const std::optional<Eigen::Vector2d> shown =
            project(photo_.camera, camera_.ray(x, y).cast<double>());
        if (!shown) return std::nullopt;
        const Eigen::Array2d pixel = shown->array() * photo_.scale;
        const Eigen::Array2d size(photo_.size.width_px, photo_.size.height_px);
        if ((pixel < 0.0).any() || (pixel > size).any()) return std::nullopt;
        if (!pyramid_.shows(pixel.matrix(), width_px_)) return std::nullopt;
        return pyramid_.at(pixel.matrix(), width_px_);
    }

    /// The mean over a pixel; nothing if a sample is missing.
    std::optional<Eigen::Array3f> mean_at(int x, int y) const
    {
        constexpr float kQuarter = 0.25F;
        Eigen::Array3f sum = Eigen::Array3f::Zero();
        for (const float down : {-kQuarter, kQuarter}) {
            for (const float right : {-kQuarter, kQuarter}) {
                const auto sample = at(static_cast<float>(x) + right, static_cast<float>(y) + down);
                if (!sample) return std::nullopt;
                sum += *sample;
            }
        }
        return 0.25F * sum;
    }

  private:
    const CalibratedPhoto& photo_;
    const Pinhole& camera_;
    double width_px_;
    PhotoPyramid pyramid_;
};

float gray(const Eigen::Array3f& color)
{
    return 0.299F * color[0] + 0.587F * color[1] + 0.114F * color[2];
}

} // namespace

GrayImage halved(const GrayImage& image)
{
    GrayImage half{image.width_px / 2, image.height_px / 2, {}};
    half.pixels.resize(static_cast<std::size_t>(half.width_px) * half.height_px);
    for (int y = 0; y < half.height_px; ++y) {
        for (int x = 0; x < half.width_px; ++x) {
            half.pixels[static_cast<std::size_t>(y) * half.width_px + x] =
                0.25F * (image.at(2 * x, 2 * y) + image.at(2 * x + 1, 2 * y) +
                         image.at(2 * x, 2 * y + 1) + image.at(2 * x + 1, 2 * y + 1));
        }
    }
    return half;
}

Pinhole halved(const Pinhole& camera)
{
    return {0.5F * camera.focal_px, 0.5F * camera.principal_px - Eigen::Vector2f::Constant(0.25F)};
}

double working_scale(const PhotographSize& photograph, int size_px)
{
    const int longest = std::max(photograph.width_px, photograph.height_px);
    return std::min(1.0, static_cast<double>(size_px) / longest);
}

StereoView stereo_view(const CalibratedPhoto& photo, int size_px)
{
    const double scale = working_scale(photo.size, size_px);
    StereoView result;
    result.view = photo.view;
    result.cam_from_world = photo.pose.cam_from_world.toRotationMatrix();
    result.center = photo.pose.center;
    const Eigen::Array2d principal = intrinsics(photo.camera)->principal_px.array() * photo.scale;
    result.camera = {static_cast<float>(photo.focal_px * scale),
                     (principal * scale - 0.5).matrix().cast<float>()};
    GrayImage& image = result.image;
    image.width_px = std::max(1, static_cast<int>(std::lround(photo.size.width_px * scale)));
    image.height_px = std::max(1, static_cast<int>(std::lround(photo.size.height_px * scale)));
    image.pixels.reserve(static_cast<std::size_t>(image.width_px) * image.height_px);
    const Undistorter photograph(photo, result.camera, 0.5 / scale, result.problem);
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            const auto color = photograph.mean_at(x, y);
            image.pixels.push_back(color ? gray(*color) : kNoGray);
            if (x % kDepthStep == 0 && y % kDepthStep == 0) {
                result.colors.push_back(color ? rounded_color(*color) : Color());
            }
        }
    }
    return result;
}

} // namespace vcarve
