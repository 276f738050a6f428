#pragma once

#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "io/dense/visibility.h"
#include "io/ply/ply_file.h"
#include "model/scene_check.h"
#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// Where a cloud and its views are.
struct DenseFiles {
    std::filesystem::path model; ///< the folder with cameras and images
    ModelFormat format = ModelFormat::binary;
    std::filesystem::path cloud; ///< PLY
    /// Which views saw its points, as stereo_fusion writes it; empty: the nearest ones that can.
    std::filesystem::path visibility;
    bool takes_lists = false; ///< but the lists of its points tell, where they fit the model
    bool are_sparse = false;  ///< the points are features of images, though they come as a cloud
};

/// A scene of the views of a model and the points of a cloud in its frame, all of them and in their
/// order: point_ids are places in the file from 0, errors are unknown, colours that the file lacks
/// are black, normals are of unit length, or zero where the file's is no direction. Of Gaussians
/// the solid ones are left (keep_solid_splats). Views and cameras are sorted by COLMAP's ids. Where
/// `notes` is not null, what was left out and which lists did not fit is added to it. Throws
/// InputError naming file and place, and Cancelled. Cost: as read_ply_cloud and VisibilityReader,
/// or nearest_sights.
Scene read_dense_scene(const DenseFiles& files, const Progress& progress = {},
                       std::vector<std::string>* notes = nullptr);

/// The same part by part, as it stands in its files, which must have a visibility.
class DenseSceneReader final : public SceneParts {
  public:
    /// Reads the views, and opens the other files.
    explicit DenseSceneReader(const DenseFiles& files, const Progress& progress = {});

    std::size_t num_points() const override { return cloud_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override;

  private:
    DenseSceneReader(const DenseFiles& files, ColmapViews model);

    Scene views_; ///< without points
    PlyReader cloud_;
    VisibilityReader visibility_;
    std::uint64_t done_ = 0; ///< points
};

/// How large the scene will be, by the cloud's header and the bytes of the files, at most where
/// these do not tell the number of sights; nothing where
/// these contradict each other, which reading will tell of. Throws InputError where the header is
/// broken. Cost: none.
std::optional<SceneSize> dense_size_before_reading(const DenseFiles& files);

} // namespace vcarve
