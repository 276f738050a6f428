#pragma once

#include "base/progress.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <vector>

namespace vcarve {

enum class ModelFormat {
    binary,
    text,
    transforms, ///< the file transforms.json of nerfstudio or instant-ngp, not a folder
};

/// The cameras and views of a model, sorted by COLMAP's ids.
struct ColmapViews {
    std::vector<Camera> cameras;
    std::vector<View> views;
    /// Indices into `views` in the order of the images file. COLMAP's visibility files number
    /// images in this order.
    std::vector<std::uint32_t> file_order;
};

/// Rays of images that are not in the model, for example because they were deleted by hand.
struct DroppedRays {
    std::uint64_t rays = 0;
    std::set<std::uint32_t> images; ///< COLMAP's ids
};

/// Reads cameras, images and points3D (.bin or .txt) of a COLMAP model, of any version since 2016.
/// Views and cameras are sorted by COLMAP's ids. All points are kept in file order, even if their
/// position is not finite. Repeated views in a track count once. Rays of missing images are
/// dropped, and counted in `dropped` unless it is null. An error of NaN becomes -1, unknown.
/// Scene::offset is zero. Files of rigs and frames are not read, because images have their own
/// poses. The 2D points of images are skipped. Throws InputError with file and position if a file
/// is missing, broken or contradicts another. Cost: linear in the size of the files, which are
/// mapped. Allocations are at most a small multiple of the file sizes.
Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress = {}, DroppedRays* dropped = nullptr);

/// Like read_colmap_model(), but passes the points on in parts of at most `most`, without cameras
/// and views, and returns the scene without points. Cost: beside a part, 8 bytes per point, for ids
/// that may repeat.
Scene read_colmap_parts(const std::filesystem::path& folder, ModelFormat format, std::size_t most,
                        const TakePoints& take, const Progress& progress = {},
                        DroppedRays* dropped = nullptr);

/// The tracks of the points of that scene, from the 2D points of its images, where COLMAP stores
/// them a second time. Cost: linear in the size of the file, plus sorting the rays.
Tracks read_tracks_of_images(const std::filesystem::path& folder, ModelFormat format,
                             const Scene& scene, const Progress& progress = {});

/// Whether more than three quarters of the images' 2D points are within 4 px of the projections of
/// their points, inside or outside the image. Cost: as read_tracks_of_images().
bool points2d_agree(const std::filesystem::path& folder, ModelFormat format, const Scene& scene);

/// Like read_colmap_model(), but does not read the points file.
ColmapViews read_colmap_views(const std::filesystem::path& folder, ModelFormat format,
                              const Progress& progress = {});

/// The size of a model, from the counts at the start of its files and from the file sizes. Empty
/// for text models, which have no counts. Also empty if files are missing or inconsistent, which
/// read_colmap_model() reports. Cost: constant.
std::optional<SceneSize> size_before_reading(const std::filesystem::path& folder,
                                             ModelFormat format);

} // namespace vcarve
