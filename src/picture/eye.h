#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// From where a surface is looked at, and through which lens.
struct Eye {
    std::string name; ///< of the image, "top" or "orbit"
    Camera camera;
    Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
    Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the model's frame, without its offset
    /// Whether backs are looked through where a front lies behind: from outside, walls and ceilings
    /// would hide what they enclose.
    bool through_backs = false;
};

/// The place that a word means.
///
/// - "auto": the view that sees most of what was looked at (seen_places), of equal ones the first
///   by COLMAP's id; "orbit" where no view's camera has a known lens, as in a laser scan.
/// - "top" and "orbit": outside the region of interest, which fills most of the picture: from
///   straight above, or 35 degrees above the side where most cameras are.
/// - else the view of that name.
///
/// Throws UsageError where there is no such view, or its lens is not known. Cost: O(sights).
Eye choose_eye(const Scene& scene, const std::string& word);

/// Width and height of a picture with the proportions of a camera's images and at most so many
/// pixels, and neither side longer than 4096.
Eigen::Array2i picture_size(const Camera& camera, double most_pixels);

/// The directions a camera's lens sees along, for a picture of another size than its images. At the
/// corners of the picture's pixels they are those of ray(); within a pixel they are blended, which
/// is off by less than a hundredth of a pixel for usual lenses, and saves most of the time.
/// Safe from many threads. Cost: a ray() per pixel, in parallel, and 24 bytes.
class LensRays {
  public:
    LensRays(const Camera& camera, const Eigen::Array2i& size_px);

    /// The unit direction, in the camera's frame, through a place in the pixel with column x and
    /// row y: `within` is (0, 0) at its upper left corner and (1, 1) at its lower right one.
    /// Nothing where the lens has none.
    std::optional<Eigen::Vector3d> at(int x, int y, const Eigen::Array2d& within) const;

  private:
    std::optional<Eigen::Vector3d> exact(const Eigen::Array2d& place) const;

    const Camera& camera_;
    Eigen::Array2d step_;                  ///< pixels of the camera a pixel of the picture
    int columns_;                          ///< of corners
    std::vector<Eigen::Vector3d> corners_; ///< zero where there is no ray
};

} // namespace vcarve
