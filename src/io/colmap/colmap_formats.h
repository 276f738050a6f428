#pragma once

#include "base/progress.h"
#include "io/colmap/scene_builder.h"

#include <cstdint>
#include <filesystem>
#include <functional>

namespace vcarve {

/// Receives a 2D point of an image: the pixel, and the id of its point, if there is such a point.
using TakeSight = std::function<void(std::uint32_t image_id, std::uint64_t point_id,
                                     const Eigen::Vector2d& place_px)>;

/// Readers of a model's three files, to be called in this order; each puts what its file holds into
/// a builder. The last reads the file of images again.
struct FormatReader {
    void (*read_cameras)(const std::filesystem::path& file, SceneBuilder& builder);
    void (*read_images)(const std::filesystem::path& file, SceneBuilder& builder,
                        const Progress& progress);
    void (*read_points)(const std::filesystem::path& file, SceneBuilder& builder,
                        const Progress& progress);
    void (*read_sights)(const std::filesystem::path& file, const TakeSight& take,
                        const Progress& progress);
};

/// cameras.bin, images.bin and points3D.bin.
extern const FormatReader kBinaryReader;
/// cameras.txt, images.txt and points3D.txt.
extern const FormatReader kTextReader;
/// transforms.json, which has no points and so no readers of them.
extern const FormatReader kTransformsReader;

/// So many records are read between two calls of Progress::tell.
inline constexpr std::uint64_t kRecordsBetweenTells = 256;

} // namespace vcarve
