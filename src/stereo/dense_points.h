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
    int size_px = 640; ///< longest side of the working images
};

/// Returns the depth map of a photograph: that of an earlier run, or what make() returns. Called
/// from many threads.
using KeepDepthMap =
    std::function<DepthMap(std::size_t photo, const std::function<DepthMap()>& make)>;

/// Peak memory of dense_points(), in bytes: working images and depth maps of all views, and per
/// thread one photograph at full size with its pyramid, or the pyramids of six working images.
std::int64_t predicted_stereo_memory(const std::vector<CalibratedPhoto>& photos,
                                     const StereoOptions& options, std::size_t threads);

/// What dense stereo measured.
struct DensePoints {
    Scene scene;
    DepthPicture picture; ///< of the depth map with the most measured pixels
};

/// A dense scene measured from photographs: depth maps by PatchMatch that starts from the surface
/// of the sparse points, fused to points that at least three views agree on. The measured points of
/// `sparse` are added. `photos` and `surface` are in the frame of `sparse`. Stages "photographs",
/// "depth" and "fuse". The result is the same for any thread count. Photographs that cannot be read
/// are left out with a note. Throws Cancelled. Cost: about 2 CPU seconds a view of 640 pixels.
DensePoints dense_points(const Reconstruction& sparse, const std::vector<CalibratedPhoto>& photos,
                         const StereoOptions& options, const KeepDepthMap& keep, Log& log);

} // namespace vcarve
