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

/// A cloud whose visibility is read: how many points it has, and its path for the messages.
struct CloudSize {
    std::uint64_t num_points = 0;
    std::filesystem::path path;
};

/// Reads part by part which views saw which point of a cloud from the file COLMAP's stereo_fusion
/// writes beside it: how many points there are (uint64), then for each of them a count and as many
/// numbers of images (uint32), which count the images as they stand in their file. The parts of the
/// file that have been read are no longer in memory.
class VisibilityReader {
  public:
    /// `file_order` turns numbers of images into numbers of views. Throws InputError where the file
    /// is missing, or tells of more or fewer points than the cloud has.
    VisibilityReader(const std::filesystem::path& path, const CloudSize& cloud,
                     std::vector<std::uint32_t> file_order);

    /// The tracks of the next points, at most so many; none after the last. A view that a point
    /// names twice counts once. Throws InputError naming the place: the file is cut off, has bytes
    /// left over, or tells of an image that is not there; and Cancelled. Cost: linear in the size
    /// of the part, in parallel but for one pass that finds where points begin; what it allocates
    /// is sized by the bytes that are there.
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

/// The tracks of points, by lists of the images that saw each, as OpenMVS writes them into its
/// clouds. It counts images as they stood in the file it imported, so `file_order` turns their
/// numbers into views; of `scene` the views and positions are looked at. Nothing, and why in
/// `note`, where the lists are those of another model: they name images that are not there, or in
/// fewer than nine of ten the point does not show. Cost: linear, and looking at some thousand
/// points.
std::optional<Tracks> tracks_of_lists(const Tracks& lists,
                                      std::span<const std::uint32_t> file_order, const Scene& scene,
                                      std::string& note);

} // namespace vcarve
