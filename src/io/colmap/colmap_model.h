#pragma once

#include "base/progress.h"
#include "model/scene_check.h"
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
    transforms, ///< no folder, but the file transforms.json of nerfstudio or instant-ngp
};

/// The cameras and views of a model, sorted by COLMAP's ids.
struct ColmapViews {
    std::vector<Camera> cameras;
    std::vector<View> views;
    /// The views as the images stand in their file: indices into `views`. What COLMAP writes beside
    /// a model counts images so.
    std::vector<std::uint32_t> file_order;
};

/// Sights of images that a model does not have, as where one was removed by hand.
struct DroppedSights {
    std::uint64_t sights = 0;
    std::set<std::uint32_t> images; ///< COLMAP's ids
};

/// Reads cameras, images and points3D (.bin or .txt) of a COLMAP model, of any version since 2016.
/// Views and cameras are sorted by COLMAP's ids. Points keep the order of the file and all of them
/// are kept, those whose position is not finite as well; a view that occurs twice in a track counts
/// once. Sights of images that are not there are dropped, and counted in `dropped` where that is
/// not null. An error that is not a number becomes -1, unknown. Scene::offset is zero. Files for
/// rigs and frames are not read, nor are the 2D points of images: images hold their own poses.
/// Throws InputError naming file and place where a file is missing, broken or contradicts another.
/// Cost: linear in the size of the files, which are mapped; allocations never exceed a small
/// multiple of the bytes that are there.
Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress = {}, DroppedSights* dropped = nullptr);

/// The tracks of the points of that scene as the 2D points of its images tell them, which COLMAP
/// keeps a second time there. Cost: linear in the size of the file, and sorting the sights.
Tracks read_tracks_of_images(const std::filesystem::path& folder, ModelFormat format,
                             const Scene& scene, const Progress& progress = {});

/// Whether more than three quarters of the 2D points of the images lie within 4 pixels of the
/// projections of their points, in the image or beyond its edges. Cost: as read_tracks_of_images.
bool points2d_agree(const std::filesystem::path& folder, ModelFormat format, const Scene& scene);

/// As read_colmap_model without the points, whose file is not read.
ColmapViews read_colmap_views(const std::filesystem::path& folder, ModelFormat format,
                              const Progress& progress = {});

/// How large a model is, before it is read: from the counts its files begin with, and from the
/// bytes they have. Nothing for a text model, whose size only shows when it is read, and for files
/// that are missing or contradict themselves, which reading will tell of. Cost: none.
std::optional<SceneSize> size_before_reading(const std::filesystem::path& folder,
                                             ModelFormat format);

} // namespace vcarve
