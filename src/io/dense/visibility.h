#pragma once

#include "base/progress.h"
#include "io/colmap/byte_reader.h"
#include "io/files/mapped_file.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// The number of points of the cloud that a visibility file belongs to, and its path for messages.
struct CloudSize {
    std::uint64_t num_points = 0;
    std::filesystem::path path;
};

/// Reads the visibility file of COLMAP's stereo_fusion (fused.ply.vis) part by part. It has the
/// number of points (uint64), then for each point a count and that many image indices (uint32).
/// Indices follow the order of the images file. The memory of parts that were read is released.
class VisibilityReader {
  public:
    /// `file_order` maps image indices to view indices. Throws InputError if the file is missing,
    /// or if its number of points differs from that of the cloud.
    VisibilityReader(const std::filesystem::path& path, const CloudSize& cloud,
                     std::vector<std::uint32_t> file_order);

    /// The tracks of the next points, at most `most`; empty after the last point. Repeated views of
    /// a point count once. Throws InputError with the position if the file is truncated, has
    /// trailing bytes, or contains an invalid image index. Throws Cancelled. Cost: linear in the
    /// size of the part, in parallel except for one pass over the row lengths. Allocations are
    /// limited by the bytes in the file.
    Tracks next(std::size_t most, const Progress& progress = {});

  private:
    std::vector<std::uint64_t> begins_of_rows(std::size_t count, const Progress& progress);

    std::filesystem::path path_;
    MappedFile file_;
    ByteReader reader_;
    std::vector<std::uint32_t> file_order_;
    std::uint64_t num_points_;
    std::uint64_t done_ = 0; ///< points
};

/// The visibility file of a cloud, as COLMAP names it: with .vis appended.
std::filesystem::path visibility_beside(const std::filesystem::path& cloud);

/// Writes points and their visibility as COLMAP's stereo_fusion does. `file_order` maps image
/// indices to view indices. Throws UsageError if a file cannot be written.
void write_dense_points(const std::filesystem::path& cloud, const Scene& scene,
                        std::span<const std::uint32_t> file_order);

/// Converts the image lists of points, as in clouds of OpenMVS, to tracks. OpenMVS numbers images
/// in the order of the images file, and `file_order` maps these indices to views. Of `scene`, only
/// views and positions are used. Returns nothing, with the reason in `note`, if the lists seem to
/// belong to another model: they contain invalid indices, or fewer than 90 % of the listed images
/// show the point. Cost: linear, plus projecting about a thousand points.
std::optional<Tracks> tracks_of_lists(const Tracks& lists,
                                      std::span<const std::uint32_t> file_order, const Scene& scene,
                                      std::string& note);

} // namespace vcarve
