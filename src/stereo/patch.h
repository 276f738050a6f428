#pragma once

#include "stereo/stereo_view.h"

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// A plane through a pixel's ray, in the camera's frame.
struct PixelPlane {
    float depth = 0.0F;                                 ///< z along the pixel's ray; 0: none
    Eigen::Vector3f normal = -Eigen::Vector3f::UnitZ(); ///< unit, towards the camera
};

/// A square patch around a pixel of the reference image: 7 x 7 samples 1.5 pixels apart, with
/// bilateral weights.
class Patch {
  public:
    static constexpr int kRadius = 3;
    static constexpr float kStepPx = 1.5F;
    static constexpr int kSide = 2 * kRadius + 1;
    static constexpr int kLanes = 56; ///< samples, filled up to a multiple of 8 with weights of 0

    /// False where the patch leaves the image; then nothing else may be called.
    bool set(const GrayImage& image, int x, int y);

    /// Gray levels; the patch shows nothing to match if it is small.
    float deviation() const { return deviation_; }

    /// The samples' weights, which sum to 1, and the weighted differences from the mean.
    const std::array<float, kLanes>& weights() const { return weights_; }
    const std::array<float, kLanes>& differences() const { return differences_; }

  private:
    alignas(32) std::array<float, kLanes> weights_;
    alignas(32) std::array<float, kLanes> differences_;
    float deviation_ = 0.0F;
};

/// A view that the reference view is matched with.
class MatchedView {
  public:
    /// Both views must outlive it. `image` and `camera` are those of `source` at some level of its
    /// pyramid.
    MatchedView(const StereoView& reference, const StereoView& source, const GrayImage& image,
                const Pinhole& camera);

    /// Dissimilarity of the patch and its image under the plane: 1 - normalized cross-correlation,
    /// from 0 to 2; negative where the source does not show the patch. The homography is
    /// linearized at the patch's center. `ray` is that of the center pixel. Cost: 49 samples.
    float cost(const Patch& patch, const Eigen::Vector3f& ray, float reference_focal_px,
               const PixelPlane& plane) const;

  private:
    const GrayImage& image_;
    Eigen::Matrix3f pixel_from_ref_;  ///< homogeneous pixels of the source from directions
    Eigen::Vector3f pixel_of_center_; ///< of the reference's center
};

} // namespace vcarve
