#pragma once

#include "io/colmap/colmap_model.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve {

/// An image as COLMAP's files hold it, without its 2D points.
struct ImageRecord {
    std::uint32_t id = 0;
    Eigen::Vector4d rotation_wxyz = Eigen::Vector4d::Zero(); ///< quaternion, camera from world
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();   ///< camera from world
    std::uint32_t camera_id = 0;
    std::string_view name;
};

/// A point as COLMAP's files hold it, without its track.
struct PointRecord {
    std::uint64_t id = 0;
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
    Color color{};
    double error_px = -1.0;
};

/// Puts a Scene together from the records of a model, whatever the format of its files, and checks
/// that they agree: ids occur once, cameras that are named exist, poses are poses. Sights of images
/// that do not exist are dropped and counted, but for placeholders: converters that know of no
/// sight write a track of image 0 or -1. To be given all cameras, then all images, then all points.
/// Throws InputError.
class SceneBuilder {
  public:
    /// Folder and format are for messages only.
    SceneBuilder(const std::filesystem::path& folder, ModelFormat format);

    void add_camera(Camera camera) { scene_.cameras.push_back(std::move(camera)); }
    /// To be called between the last camera and the first image.
    void close_cameras();

    void add_image(const ImageRecord& image);
    /// To be called between the last image and the first point.
    void close_images();

    /// So many points and sights will come, or a few less.
    void reserve_points(std::size_t count, std::size_t sights);
    /// `image_ids` may be in any order and name an image more than once.
    void add_point(const PointRecord& point, std::span<const std::uint32_t> image_ids);

    /// What was dropped up to now.
    const DroppedSights& dropped() const { return dropped_; }
    /// The scene, its cameras and views sorted by COLMAP's ids; the builder is spent.
    Scene finish();
    /// Only what belongs to the images; the builder is spent.
    ColmapViews finish_views();

  private:
    /// kNoView where no image has that id.
    std::uint32_t view_index(std::uint32_t image_id) const;
    void refuse_point_ids_twice() const;

    std::filesystem::path folder_;
    ModelFormat format_;
    Scene scene_;
    std::vector<std::uint32_t> file_ids_;  ///< of the images, as they were added
    std::vector<std::uint32_t> image_ids_; ///< ascending, parallel to the views
    std::vector<std::uint32_t> row_;       ///< view indices of the point being added
    DroppedSights dropped_;
    bool point_ids_ascend_ = true; ///< of the points so far, so that none occurs twice
};

} // namespace vcarve
