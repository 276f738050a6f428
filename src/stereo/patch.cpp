#include "stereo/patch.h"

#include "stereo/gray_weights.h"
#include "stereo/vectorized.h"

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

constexpr int kLanes = Patch::kLanes;
constexpr int kWidth = 8; ///< partial sums, so that their order is the same on any processor

using Lanes = std::array<float, kLanes>;

/// Offsets of the samples from the patch's center, in pixels of the reference.
struct Offsets {
    alignas(32) Lanes x{};
    alignas(32) Lanes y{};
};

constexpr Offsets make_offsets()
{
    Offsets offsets;
    for (int k = 0; k < Patch::kSide * Patch::kSide; ++k) {
        const int column = k % Patch::kSide;
        const int row = k / Patch::kSide;
        offsets.x[k] = static_cast<float>(column - Patch::kRadius) * Patch::kStepPx;
        offsets.y[k] = static_cast<float>(row - Patch::kRadius) * Patch::kStepPx;
    }
    return offsets;
}

constexpr Offsets kOffsets = make_offsets();

/// Weights of samples by their distance from the center.
Lanes near_weights()
{
    constexpr float kSigmaPx = 6.0F;
    Lanes weights{};
    for (int k = 0; k < Patch::kSide * Patch::kSide; ++k) {
        const float far_sq = kOffsets.x[k] * kOffsets.x[k] + kOffsets.y[k] * kOffsets.y[k];
        weights[k] = std::exp(-0.5F * far_sq / (kSigmaPx * kSigmaPx));
    }
    return weights;
}

/// Weighted sums over the samples of a footprint.
struct Sums {
    float value = 0.0F;
    float square = 0.0F;
    float product = 0.0F; ///< with the differences
};

VCARVE_VECTORIZED
Sums sums_over(const GrayImage& image, const Footprint& at, const Lanes& weights,
               const Lanes& differences)
{
    const float* const pixels = image.pixels.data();
    const int width = image.width_px;
    alignas(32) float values[kLanes];
    for (int k = 0; k < kLanes; ++k) {
        const float x = at.x_at(kOffsets.x[k], kOffsets.y[k]);
        const float y = at.y_at(kOffsets.x[k], kOffsets.y[k]);
        const int column = static_cast<int>(x);
        const int row = static_cast<int>(y);
        const float right = x - static_cast<float>(column);
        const float down = y - static_cast<float>(row);
        const int index = row * width + column;
        const float upper = pixels[index] + right * (pixels[index + 1] - pixels[index]);
        const float lower =
            pixels[index + width] + right * (pixels[index + width + 1] - pixels[index + width]);
        values[k] = upper + down * (lower - upper);
    }
    alignas(32) float value[kWidth] = {};
    alignas(32) float square[kWidth] = {};
    alignas(32) float product[kWidth] = {};
    for (int k = 0; k < kLanes; k += kWidth) {
        for (int lane = 0; lane < kWidth; ++lane) {
            const float weighted = weights[k + lane] * values[k + lane];
            value[lane] += weighted;
            square[lane] += weighted * values[k + lane];
            product[lane] += differences[k + lane] * values[k + lane];
        }
    }
    Sums sums;
    for (int lane = 0; lane < kWidth; ++lane) {
        sums.value += value[lane];
        sums.square += square[lane];
        sums.product += product[lane];
    }
    return sums;
}

/// Variance of the central 3 x 3 samples.
float inner_variance(const Lanes& values)
{
    float sum = 0.0F;
    float square = 0.0F;
    const float center = values[Patch::kSide * Patch::kRadius + Patch::kRadius];
    for (int y = -1; y <= 1; ++y) {
        for (int x = -1; x <= 1; ++x) {
            const int k = (Patch::kRadius + y) * Patch::kSide + Patch::kRadius + x;
            sum += values[k] - center;
            square += (values[k] - center) * (values[k] - center);
        }
    }
    return square / 9.0F - (sum / 9.0F) * (sum / 9.0F);
}

float bilinear(const GrayImage& image, float x, float y)
{
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const float right = x - static_cast<float>(column);
    const float down = y - static_cast<float>(row);
    const float upper =
        image.at(column, row) + right * (image.at(column + 1, row) - image.at(column, row));
    const float lower = image.at(column, row + 1) +
                        right * (image.at(column + 1, row + 1) - image.at(column, row + 1));
    return upper + down * (lower - upper);
}

} // namespace

bool Footprint::is_inside(int width_px, int height_px) const
{
    constexpr float kReach = Patch::kRadius * Patch::kStepPx;
    const Footprint upright = {x, y, std::abs(xx), std::abs(xy), std::abs(yx), std::abs(yy)};
    return upright.x_at(-kReach, -kReach) >= 0.0F && upright.y_at(-kReach, -kReach) >= 0.0F &&
           upright.x_at(kReach, kReach) < static_cast<float>(width_px - 1) &&
           upright.y_at(kReach, kReach) < static_cast<float>(height_px - 1);
}

bool Patch::set(const GrayImage& image, int x, int y)
{
    static const GrayWeights gray_weights(25.0F);
    static const Lanes near = near_weights();
    // Pixels without texture beside a strong edge would match at the depth of the edge.
    constexpr float kLeastInnerShare = 0.1F;
    const Footprint at = {static_cast<float>(x), static_cast<float>(y), 1.0F, 0.0F, 0.0F, 1.0F};
    if (!at.is_inside(image.width_px, image.height_px)) return false;
    weights_.fill(0.0F);
    differences_.fill(0.0F);
    const float center = image.at(x, y);
    Lanes values{};
    float sum = 0.0F;
    float mean = 0.0F;
    for (int k = 0; k < kSide * kSide; ++k) {
        values[k] = bilinear(image, at.x + kOffsets.x[k], at.y + kOffsets.y[k]);
        if (std::isnan(values[k])) return false;
        weights_[k] = near[k] * gray_weights.of(values[k] - center);
        sum += weights_[k];
        mean += weights_[k] * values[k];
    }
    mean /= sum;
    float variance = 0.0F;
    for (int k = 0; k < kSide * kSide; ++k) {
        weights_[k] /= sum;
        differences_[k] = weights_[k] * (values[k] - mean);
        variance += differences_[k] * (values[k] - mean);
    }
    deviation_ = std::sqrt(variance);
    if (inner_variance(values) < kLeastInnerShare * variance) deviation_ = 0.0F;
    return true;
}

MatchedView::MatchedView(const StereoView& reference, const StereoView& source,
                         const GrayImage& image, const Pinhole& camera)
    : image_(image)
{
    Eigen::Matrix3d pixel_from_cam = Eigen::Matrix3d::Identity();
    pixel_from_cam(0, 0) = pixel_from_cam(1, 1) = camera.focal_px;
    pixel_from_cam.topRightCorner<2, 1>() = camera.principal_px.cast<double>();
    pixel_from_ref_ =
        (pixel_from_cam * source.cam_from_world * reference.cam_from_world.transpose())
            .cast<float>();
    pixel_of_center_ =
        (pixel_from_cam * source.cam_from_world * (reference.center - source.center)).cast<float>();
}

float MatchedView::cost(const Patch& patch, const Eigen::Vector3f& ray, float reference_focal_px,
                        const PixelPlane& plane) const
{
    constexpr float kLeastVariance = 1.0F; // gray levels squared
    // The plane is z = distance / (normal . ray), so it maps rays by a homography.
    const float distance = plane.depth * plane.normal.dot(ray);
    const Eigen::Vector3f scaled = plane.normal / distance;
    const Eigen::Matrix3f homography = pixel_from_ref_ + pixel_of_center_ * scaled.transpose();
    const Eigen::Vector3f center = homography * ray;
    if (!(center.z() > 0.0F)) return -1.0F;
    const float inverse = 1.0F / center.z();
    const Eigen::Vector2f pixel = inverse * center.head<2>();
    const float scale = inverse / reference_focal_px;
    const auto change = [&](int axis) -> Eigen::Vector2f {
        return scale * (homography.col(axis).head<2>() - homography(2, axis) * pixel);
    };
    const Eigen::Vector2f right = change(0);
    const Eigen::Vector2f down = change(1);
    const Footprint at = {pixel.x(), pixel.y(), right.x(), down.x(), right.y(), down.y()};
    if (!at.is_inside(image_.width_px, image_.height_px)) return -1.0F;
    const Sums sums = sums_over(image_, at, patch.weights(), patch.differences());
    const float variance = sums.square - sums.value * sums.value;
    if (!(variance >= kLeastVariance)) return std::isnan(variance) ? -1.0F : 1.0F;
    const float correlation = sums.product / (std::sqrt(variance) * patch.deviation());
    return 1.0F - std::clamp(correlation, -1.0F, 1.0F);
}

} // namespace vcarve
