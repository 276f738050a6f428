#include "io/colmap/colmap_model.h"

#include "base/arrays.h"
#include "io/colmap/colmap_formats.h"
#include "io/colmap/model_files.h"
#include "io/colmap/scene_builder.h"
#include "model/camera.h"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <system_error>
#include <utility>

namespace vcarve {
namespace {

/// The size in bytes; 0 if the file is missing, which reading it reports.
double size_of_file(const std::filesystem::path& path)
{
    std::error_code none;
    const auto size = std::filesystem::file_size(path, none);
    return none ? 0.0 : static_cast<double>(size);
}

const FormatReader& reader_of(ModelFormat format)
{
    if (format == ModelFormat::transforms) return kTransformsReader;
    return format == ModelFormat::binary ? kBinaryReader : kTextReader;
}

SceneBuilder read_views(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress)
{
    const FormatReader& reader = reader_of(format);
    SceneBuilder builder(folder, format);
    reader.read_cameras(model_path(folder, "cameras", format), builder);
    reader.read_images(model_path(folder, "images", format), builder, progress);
    return builder;
}

/// Calls take(point, view, place_px) for each 2D point that belongs to a point of the scene.
template <typename Take>
void visit_points2d(const std::filesystem::path& folder, ModelFormat format, const Scene& scene,
                    const Progress& progress, const Take& take)
{
    std::vector<std::uint32_t> by_id(scene.num_points());
    std::iota(by_id.begin(), by_id.end(), 0U);
    const auto id_of = [&](std::uint32_t point) { return scene.point_ids[point]; };
    std::ranges::sort(by_id, {}, id_of);
    const auto find = [&](std::uint32_t image_id, std::uint64_t point_id,
                          const Eigen::Vector2d& place_px) {
        const auto point = std::ranges::lower_bound(by_id, point_id, {}, id_of);
        if (point == by_id.end() || id_of(*point) != point_id) return;
        const auto view = std::ranges::lower_bound(scene.views, image_id, {}, &View::id);
        take(*point, static_cast<std::uint32_t>(view - scene.views.begin()), place_px);
    };
    reader_of(format).read_rays(model_path(folder, "images", format), find, progress);
}

constexpr std::uint64_t kCountBytes = 8;

/// The count at the start of a binary file.
std::optional<std::uint64_t> first_count(const std::filesystem::path& path)
{
    std::ifstream file(path, std::ios::binary);
    std::uint64_t count = 0;
    file.read(reinterpret_cast<char*>(&count), kCountBytes);
    return file ? std::optional(count) : std::nullopt;
}

} // namespace

Scene read_colmap_model(const std::filesystem::path& folder, ModelFormat format,
                        const Progress& progress, DroppedRays* dropped)
{
    return read_colmap_parts(folder, format, SIZE_MAX, nullptr, progress, dropped);
}

Scene read_colmap_parts(const std::filesystem::path& folder, ModelFormat format, std::size_t most,
                        const TakePoints& take, const Progress& progress, DroppedRays* dropped)
{
    const std::filesystem::path points_file = model_path(folder, "points3D", format);
    const double images = size_of_file(model_path(folder, "images", format));
    const double points = size_of_file(points_file);
    const double middle = images / (images + points + 1.0); // progress is proportional to bytes
    SceneBuilder builder = read_views(folder, format, progress.part(0.0, middle));
    builder.pass_on(most, take);
    reader_of(format).read_points(points_file, builder, progress.part(middle, 1.0));
    if (dropped != nullptr) *dropped = builder.dropped();
    return builder.finish();
}

Tracks read_tracks_of_images(const std::filesystem::path& folder, ModelFormat format,
                             const Scene& scene, const Progress& progress)
{
    std::vector<std::pair<std::uint32_t, std::uint32_t>> rays; // point, view
    visit_points2d(folder, format, scene, progress,
                   [&](std::uint32_t point, std::uint32_t view, const Eigen::Vector2d& /*px*/) {
                       rays.emplace_back(point, view);
                   });
    sort_unique(rays);
    Tracks tracks;
    auto ray = rays.begin();
    for (std::uint32_t point = 0; point < scene.num_points(); ++point) {
        for (; ray != rays.end() && ray->first == point; ++ray) {
            tracks.views.push_back(ray->second);
        }
        tracks.begins.push_back(tracks.views.size());
    }
    return tracks;
}

bool points2d_agree(const std::filesystem::path& folder, ModelFormat format, const Scene& scene)
{
    constexpr double kNearPx = 4.0; // the largest error that COLMAP's mapper keeps
    std::size_t all = 0;
    std::size_t near = 0;
    visit_points2d(folder, format, scene, {},
                   [&](std::uint32_t point, std::uint32_t view, const Eigen::Vector2d& place_px) {
                       const View& from = scene.views[view];
                       const auto shown =
                           project(scene.cameras[from.camera],
                                   from.cam_from_world * (scene.positions[point] - from.center));
                       ++all;
                       near += shown && (*shown - place_px).norm() <= kNearPx ? 1 : 0;
                   });
    return 4 * near > 3 * all;
}

ColmapViews read_colmap_views(const std::filesystem::path& folder, ModelFormat format,
                              const Progress& progress)
{
    return read_views(folder, format, progress).finish_views();
}

std::optional<SceneSize> size_before_reading(const std::filesystem::path& folder,
                                             ModelFormat format)
{
    if (format != ModelFormat::binary) return std::nullopt;
    const std::filesystem::path points_file = folder / model_file("points3D", format);
    const auto points = first_count(points_file);
    const auto views = first_count(folder / model_file("images", format));
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(points_file, error);
    // Bytes that are not points are tracks: an image id and the index of a 2D point per ray.
    constexpr std::uint64_t kRayBytes = 8;
    if (!points || !views || error || *points > bytes / kPointBytes) return std::nullopt;
    const std::uint64_t others = kCountBytes + *points * kPointBytes;
    if (others > bytes) return std::nullopt;
    return SceneSize{.points = *points, .rays = (bytes - others) / kRayBytes, .views = *views};
}

} // namespace vcarve
