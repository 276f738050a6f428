#include "io/colmap/model_size.h"

#include "io/colmap/model_files.h"

#include <fstream>
#include <system_error>

namespace vcarve {

namespace {

constexpr std::uint64_t kCountBytes = 8;

/// The count a binary file begins with.
std::optional<std::uint64_t> first_count(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::uint64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), kCountBytes);
    return file ? std::optional(count) : std::nullopt;
}

} // namespace

std::optional<SceneSize> size_before_reading(const std::filesystem::path& folder,
                                             ModelFormat format)
{
    if (format != ModelFormat::binary) return std::nullopt;
    const std::filesystem::path points_file = folder / model_file("points3D", format);
    const auto points = first_count(points_file);
    const auto views = first_count(folder / model_file("images", format));
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(points_file, error);
    // What is no point is tracks: an image id and the index of a 2D point for each sight.
    constexpr std::uint64_t kSightBytes = 8;
    if (!points || !views || error || *points > bytes / kPointBytes) return std::nullopt;
    const std::uint64_t others = kCountBytes + *points * kPointBytes;
    if (others > bytes) return std::nullopt;
    return SceneSize{.points = *points, .sights = (bytes - others) / kSightBytes, .views = *views};
}

} // namespace vcarve
