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

/// The files of a cloud and its views.
struct DenseFiles {
    std::filesystem::path model; ///< the folder with cameras and images
    ModelFormat format = ModelFormat::binary;
    std::filesystem::path cloud; ///< PLY
    /// The views of each point, written by stereo_fusion. If empty, nearest_rays() finds the views.
    std::filesystem::path visibility;
    bool takes_lists = false; ///< use the points' own view lists, if they fit the model
    bool are_sparse = false;  ///< the points of the cloud are image features
};

/// Reads the views of a model, and all points of a cloud in the model's frame, in file order.
/// point_ids count the vertices of the file from 0; take_attributes() describes the attributes.
/// Without a visibility file, only solid Gaussians are kept (keep_solid_splats). Views and cameras
/// are sorted by COLMAP's ids. If `notes` is not null, it receives notes about dropped Gaussians
/// and lists that do not fit the model. Throws InputError with file and position, and Cancelled.
/// Cost: as read_ply_cloud and VisibilityReader, or nearest_rays.
Scene read_dense_scene(const DenseFiles& files, const Progress& progress = {},
                       std::vector<std::string>* notes = nullptr);

/// Reads that scene part by part, in file order. Precondition: it has a visibility file.
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

/// The size of the scene, from the header of the cloud and the sizes of the files. If these do not
/// determine the number of rays, it is an upper bound. Empty if they contradict each other, which
/// read_dense_scene() reports. Throws InputError if the header is broken. Cost: constant.
std::optional<SceneSize> dense_size_before_reading(const DenseFiles& files);

} // namespace vcarve
