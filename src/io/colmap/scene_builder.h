#pragma once

#include "io/colmap/colmap_model.h"
#include "model/scene_points.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve {

/// An image record of COLMAP's files, without its 2D points.
struct ImageRecord {
    std::uint32_t id = 0;
    Eigen::Vector4d rotation_wxyz = Eigen::Vector4d::Zero(); ///< quaternion, camera from world
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< camera from world
    std::uint32_t camera_id = 0;
    std::string_view name;
};

/// A point record of COLMAP's files, without its track.
struct PointRecord {
    std::uint64_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Color color{};
    double error_px = -1.0;
};

/// Builds a Scene from the records of a model in any format. Throws InputError if records disagree:
/// if ids repeat, an image uses a missing camera, or a pose is not valid. Rays of missing images
/// are dropped and counted. Image ids 0 and -1 are dropped without counting: some converters write
/// them as placeholders for points without rays. Add all cameras, then all images, then all points.
class SceneBuilder {
  public:
    /// `folder` and `format` are for messages only.
    SceneBuilder(const std::filesystem::path& folder, ModelFormat format);

    void add_camera(Camera camera) { scene_.cameras.push_back(std::move(camera)); }
    /// Call it between the last camera and the first image.
    void close_cameras();

    void add_image(const ImageRecord& image);
    /// Call it between the last image and the first point.
    void close_images();

    /// Passes points on in parts of at most `most`, without cameras and views, instead of keeping
    /// them. Call it before the first point.
    void pass_on(std::size_t most, TakePoints take);
    /// Reserves memory for this number of points and rays, or slightly fewer.
    void reserve_points(std::size_t count, std::size_t rays);
    /// `image_ids` may be in any order and may repeat.
    void add_point(const PointRecord& point, std::span<const std::uint32_t> image_ids);

    /// The rays dropped so far.
    const DroppedRays& dropped() const { return dropped_; }
    /// The scene, with cameras and views sorted by COLMAP's ids, and without points that were
    /// passed on. Empties the builder.
    Scene finish();
    /// Cameras and views only. Empties the builder.
    ColmapViews finish_views();

  private:
    /// kNoView if no image has that id.
    std::uint32_t view_index(std::uint32_t image_id) const;
    void refuse_point_ids_twice();
    void pass_points_on();

    std::filesystem::path folder_;
    ModelFormat format_;
    Scene scene_;
    std::vector<std::uint32_t> file_ids_;  ///< of the images, in the order added
    std::vector<std::uint32_t> image_ids_; ///< ascending, parallel to the views
    std::vector<std::uint32_t> row_;       ///< view indices of the point being added
    DroppedRays dropped_;
    bool point_ids_ascend_ = true; ///< of the points so far; then none repeats
    std::size_t most_ = SIZE_MAX;  ///< points of a part
    TakePoints take_;
    std::vector<std::uint64_t> passed_ids_; ///< of points that were passed on
};

} // namespace vcarve
