#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <optional>
#include <vector>

namespace vcarve {

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
