#pragma once

#include "base/progress.h"
#include "io/colmap/scene_builder.h"

#include <filesystem>

namespace vcarve {

/// Read cameras.bin and images.bin of a folder into a builder, in that order.
void read_binary_views(const std::filesystem::path& folder, SceneBuilder& builder,
                       const Progress& progress);

/// Read cameras.bin, images.bin and points3D.bin of a folder into a builder, in that order.
void read_binary_files(const std::filesystem::path& folder, SceneBuilder& builder,
                       const Progress& progress);

/// Read cameras.txt and images.txt of a folder into a builder, in that order.
void read_text_views(const std::filesystem::path& folder, SceneBuilder& builder,
                     const Progress& progress);

/// Read cameras.txt, images.txt and points3D.txt of a folder into a builder, in that order.
void read_text_files(const std::filesystem::path& folder, SceneBuilder& builder,
                     const Progress& progress);

/// Shares of reading a model: images before points by the sizes of their files.
struct ReadingShares {
    Progress images;
    Progress points;
};
ReadingShares shares_of(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress);

/// So many records are read between two calls of Progress::tell.
inline constexpr std::uint64_t kRecordsBetweenTells = 256;

} // namespace vcarve
