#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// A viewpoint and its lens.
struct Eye {
    std::string name; ///< the image name, "top" or "orbit"
    Camera camera;
    Eigen::Quaterniond cam_from_world = Eigen::Quaterniond::Identity();
    Eigen::Vector3d center = Eigen::Vector3d::Zero(); ///< in the model's frame, offset included
    /// Whether back faces are transparent if a front face is behind them. From outside, walls and
    /// ceilings would otherwise hide the interior.
    bool through_backs = false;
};

/// Returns the viewpoint that a word selects.
///
/// - "auto": the view that sees most of the region of interest (seen_places), with the lowest id of
///   COLMAP if equal. "orbit" if no lens is known, as in laser scans.
/// - "top" and "orbit": outside the region of interest, which fills most of the picture. "top" is
///   straight above, "orbit" 35 degrees above the side with most cameras.
/// - other words: the view of this name.
///
/// Throws UsageError if the view does not exist or its lens is unknown. Cost: O(rays).
Eye choose_eye(const Scene& scene, const std::string& word);

/// The view of that name. Throws UsageError if there is none, or if its lens is unknown.
const View& named_view(const Scene& scene, const std::string& name);

/// The width and height of a picture with the aspect ratio of the camera, at most `most_pixels`
/// pixels, and sides of at most 4096 pixels.
Eigen::Array2i picture_size(const Camera& camera, double most_pixels);

/// The ray directions of a lens, for a picture of any size. Directions at pixel corners are
/// computed by ray(), and interpolated within pixels. This saves most of the time, and the error is
/// less than .01 pixels for usual lenses. Thread-safe. Cost: one ray() per pixel, in parallel, and
/// 24 bytes.
class LensRays {
  public:
    LensRays(const Camera& camera, const Eigen::Array2i& size_px);

    /// The unit direction in the camera's frame through a position in the pixel at column x and row
    /// y: `within` is (0, 0) at its upper left corner and (1, 1) at its lower right corner. Nothing
    /// if the lens has no direction there.
    std::optional<Eigen::Vector3d> at(int x, int y, const Eigen::Array2d& within) const;

  private:
    std::optional<Eigen::Vector3d> exact(const Eigen::Array2d& place) const;

    const Camera& camera_;
    Eigen::Array2d step_;                  ///< camera pixels per picture pixel
    int columns_;                          ///< number of corners per row
    std::vector<Eigen::Vector3d> corners_; ///< zero if there is no ray
};

} // namespace vcarve
