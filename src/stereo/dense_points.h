#pragma once

#include "stereo/depth_picture.h"
#include "stereo/patch_match.h"
#include "texture/calibrated_photo.h"
#include "vcarve/log.h"
#include "vcarve/reconstruct.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vcarve {

/// Options of dense stereo.
struct StereoOptions {
    int size_px = 640; ///< maximum side of the working images
};

/// Returns the depth map of a photograph: from an earlier run, or made by make(). Called from many
/// threads.
using KeepDepthMap =
    std::function<DepthMap(std::size_t photo, const std::function<DepthMap()>& make)>;

/// Predicts the peak memory of dense_points() in bytes: working images and depth maps of all views.
/// Each thread adds a photograph at full size with its pyramid, or six pyramids of working images.
std::int64_t predicted_stereo_memory(const std::vector<CalibratedPhoto>& photos,
                                     const StereoOptions& options, std::size_t threads);

/// The result of dense_points().
struct DensePoints {
    Scene scene;
    DepthPicture picture; ///< of the depth map with the most measured pixels
};

/// Measures a dense scene from photographs. PatchMatch computes depth maps, starting from the mesh
/// of `sparse`. Pixels on which at least three views agree are fused to points, and the measured
/// points of `sparse` are added. `photos` are in the frame of `sparse`. Reports the stages
/// "undistort", "depth" and "fuse". The result is the same for any thread count. Unreadable
/// photographs are skipped with a note. Throws Cancelled. Cost: about 2 CPU s per view of 640 px.
DensePoints dense_points(const Reconstruction& sparse, const std::vector<CalibratedPhoto>& photos,
                         const StereoOptions& options, const KeepDepthMap& keep, Log& log);

} // namespace vcarve
