#pragma once

#include "base/progress.h"
#include "io/colmap/scene_builder.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace vcarve {

/// Receives a 2D point of an image: its pixel, and a point id that may not exist in the model.
using TakeRay = std::function<void(std::uint32_t image_id, std::uint64_t point_id,
                                   const Eigen::Vector2d& place_px)>;

/// Readers of a model's three files. Call them in this order; each adds the records of its file to
/// a builder. read_rays reads the images file again.
struct FormatReader {
    void (*read_cameras)(const std::filesystem::path& file, SceneBuilder& builder);
    void (*read_images)(const std::filesystem::path& file, SceneBuilder& builder,
                        const Progress& progress);
    void (*read_points)(const std::filesystem::path& file, SceneBuilder& builder,
                        const Progress& progress);
    void (*read_rays)(const std::filesystem::path& file, const TakeRay& take,
                      const Progress& progress);
};

/// cameras.bin, images.bin and points3D.bin.
extern const FormatReader kBinaryReader;
/// cameras.txt, images.txt and points3D.txt.
extern const FormatReader kTextReader;
/// transforms.json. It has no points, so read_points and read_rays are null.
extern const FormatReader kTransformsReader;

/// Number of records between two calls of Progress::report.
inline constexpr std::uint64_t kRecordsBetweenReports = 256;

} // namespace vcarve
