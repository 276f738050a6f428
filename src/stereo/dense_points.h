#pragma once

#include "texture/calibrated_photo.h"
#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// Options of dense stereo.
struct StereoOptions {
    int size_px = 640; ///< longest side of the working images
};

/// A dense scene measured from photographs: depth maps by PatchMatch that starts from the surface
/// of the sparse points, fused to points that at least three views agree on. The measured points of
/// `sparse` are added. `photos` and `surface` are in the frame of `sparse`. Stages "photographs",
/// "depth" and "fuse". The result is the same for any thread count. Throws InputError if a
/// photograph cannot be read, and Cancelled. Cost: about 2 CPU seconds a view.
Scene dense_points(const Scene& sparse, const TriMesh& surface,
                   const std::vector<CalibratedPhoto>& photos, const StereoOptions& options,
                   Log& log);

} // namespace vcarve
