#pragma once

#include "stereo/stereo_view.h"

#include <Eigen/Core>

#include <array>

namespace vcarve {

/// A plane through a pixel's ray, in the camera's frame.
struct PixelPlane {
    float depth = 0.0F;                                 ///< z along the pixel's ray; 0: no plane
    Eigen::Vector3f normal = -Eigen::Vector3f::UnitZ(); ///< unit vector, towards the camera
};

/// A square patch around a pixel of the reference image: 7 x 7 samples 1.5 pixels apart, with
/// bilateral weights.
class Patch {
  public:
    static constexpr int kRadius = 3;
    static constexpr float kStepPx = 1.5F;
    static constexpr int kSide = 2 * kRadius + 1;
    static constexpr int kLanes = 56; ///< samples, padded to a multiple of 8 with weights of 0

    /// Returns false if the patch leaves the image or touches a pixel of kNoGray; then no other
    /// function may be called.
    bool set(const GrayImage& image, int x, int y);

    /// Standard deviation in gray levels. If it is small, the patch has no texture to match.
    float deviation() const { return deviation_; }

    /// The samples' weights, which sum to 1, and the weighted differences from the mean.
    const std::array<float, kLanes>& weights() const { return weights_; }
    const std::array<float, kLanes>& differences() const { return differences_; }

  private:
    alignas(32) std::array<float, kLanes> weights_;
    alignas(32) std::array<float, kLanes> differences_;
    float deviation_ = 0.0F;
};

/// The center of a patch in a source image, and the linear map of its pixels there.
struct Footprint {
    float x, y;   ///< pixel
    float xx, xy; ///< change of x per pixel to the right, and down
    float yx, yy;

    /// The pixel of a sample that is `right` and `down` of the center, in pixels of the reference.
    float x_at(float right, float down) const { return x + xx * right + xy * down; }
    float y_at(float right, float down) const { return y + yx * right + yy * down; }

    /// Whether all samples and their right and lower neighbors lie in an image of this size. Holds
    /// for the rounded samples: rounding is monotonic, so those in the corners are the outermost.
    bool is_inside(int width_px, int height_px) const;
};

/// A view that the reference view is matched with.
class MatchedView {
  public:
    /// `image` (must outlive the object) and `camera` are a level of the pyramid of `source`.
    MatchedView(const StereoView& reference, const StereoView& source, const GrayImage& image,
                const Pinhole& camera);

    /// Dissimilarity of the patch and its image under the plane: 1 - normalized cross-correlation,
    /// from 0 to 2; negative if the source does not show the whole patch, or a sample touches a
    /// pixel of kNoGray. The homography is linearized at the center of the patch, whose ray is
    /// `ray`. Cost: 49 samples.
    float cost(const Patch& patch, const Eigen::Vector3f& ray, float reference_focal_px,
               const PixelPlane& plane) const;

  private:
    const GrayImage& image_;
    Eigen::Matrix3f pixel_from_ref_;  ///< maps directions to homogeneous source pixels
    Eigen::Vector3f pixel_of_center_; ///< of the reference's camera center
};

} // namespace vcarve
