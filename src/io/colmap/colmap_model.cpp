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

const FormatReader& reader_of(ModelFormat format)
{
    return format == ModelFormat::binary ? kBinaryReader : kTextReader;
}

SceneBuilder read_views(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress)
{
    const FormatReader& reader = reader_of(format);
    SceneBuilder builder(folder, format);
    reader.read_cameras(folder / model_file("cameras", format), builder);
    reader.read_images(folder / model_file("images", format), builder, progress);
    return builder;
}

} // namespace

Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress)
{
    const std::filesystem::path points_file = folder / model_file("points3D", format);
    const double images = size_of_file(folder / model_file("images", format));
    const double points = size_of_file(points_file);
    const double middle = images / (images + points + 1.0); // the same time for all bytes
    SceneBuilder builder = read_views(folder, format, progress.part(0.0, middle));
    reader_of(format).read_points(points_file, builder, progress.part(middle, 1.0));
    return builder.finish();
}

ColmapViews read_colmap_views(const std::filesystem::path& folder, ModelFormat format,
                              const Progress& progress)
{
    return read_views(folder, format, progress).finish_views();
}

} // namespace vcarve
