#include "io/colmap/colmap_model.h"

#include "io/colmap/colmap_formats.h"
#include "io/colmap/model_files.h"
#include "io/colmap/scene_builder.h"

#include <system_error>

namespace vcarve {

namespace {

/// 0 for a file that is not there: reading it will say so.
double size_of_file(const std::filesystem::path& path)
{
    std::error_code none;
    const auto size = std::filesystem::file_size(path, none);
    return none ? 0.0 : static_cast<double>(size);
}

} // namespace

ReadingShares shares_of(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress)
{
    const double images = size_of_file(folder / model_file("images", format));
    const double points = size_of_file(folder / model_file("points3D", format));
    const double middle = images / (images + points + 1.0);
    return {progress.part(0.0, middle), progress.part(middle, 1.0)};
}

Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress)
{
    SceneBuilder builder(folder, format);
    if (format == ModelFormat::binary) {
        read_binary_files(folder, builder, progress);
    } else {
        read_text_files(folder, builder, progress);
    }
    return builder.finish();
}

ColmapViews read_colmap_views(const std::filesystem::path& folder, ModelFormat format,
                              const Progress& progress)
{
    SceneBuilder builder(folder, format);
    if (format == ModelFormat::binary) {
        read_binary_views(folder, builder, progress);
    } else {
        read_text_views(folder, builder, progress);
    }
    return builder.finish_views();
}

} // namespace vcarve
