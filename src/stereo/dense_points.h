#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace vcarve {

/// Returns the depth map of a photograph: from an earlier run, or made by make(). Called from many
/// threads.
using KeepDepthMap =
    std::function<DepthMap(std::size_t photo, const std::function<DepthMap()>& make)>;

/// What the steps of dense stereo make of the photographs. The arrays are parallel.
struct DenseStereo {
    std::vector<StereoView> views{};                     ///< by undistort_photos()
    std::vector<std::vector<std::uint32_t>> neighbors{}; ///< by match_views(): views to fuse with
    std::vector<DepthMap> maps{};                        ///< by match_views()
};

/// Predicts the memory of the working images and depth maps in bytes, of photographs with these
/// sizes. Each thread adds a photograph at full size with its pyramid, or six pyramids of working
/// images.
double stereo_bytes(std::span<const PhotographSize> photos, const DenseOptions& options,
                    double threads);

/// Reads the photographs, in the frame of the sparse scene, and removes the distortion of their
/// lenses. An unreadable photograph has an error in StereoView::problem. Throws Cancelled.
std::vector<StereoView> undistort_photos(const std::vector<CalibratedPhoto>& photos,
                                         const DenseOptions& options, const Progress& progress);

/// Computes a depth map of each view with PatchMatch, starting from `surface`, the mesh of the
/// sparse scene in its frame. The result is the same for any thread count. Throws Cancelled. Cost:
/// about 2 CPU s per view of 640 px.
void match_views(const Scene& sparse, const TriMesh& surface, const KeepDepthMap& keep,
                 DenseStereo& stereo, const Progress& progress);

/// Appends the measured points of the sparse scene to the dense one, which fuse() made.
void add_measured(const Scene& sparse, Scene& dense);

} // namespace vcarve
