#include "io/dense/dense_scene.h"

#include "base/numbers.h"
#include "io/colmap/colmap_model.h"
#include "io/dense/cloud_points.h"
#include "io/dense/nearest_rays.h"
#include "io/dense/visibility.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <functional>
#include <system_error>
#include <utility>

namespace vcarve {

namespace {

/// The number of rays that fit into the file beside the row lengths of `num_points` points.
std::optional<std::uint64_t> rays_in(const std::filesystem::path& visibility,
                                     std::uint64_t num_points)
{
    constexpr std::uint64_t kCountBytes = 8;
    constexpr std::uint64_t kNumberBytes = 4;
    std::error_code error;
    const std::uint64_t bytes = std::filesystem::file_size(visibility, error);
    if (error || bytes < kCountBytes) return std::nullopt;
    const std::uint64_t numbers = (bytes - kCountBytes) / kNumberBytes;
    if (num_points > numbers) return std::nullopt;
    return numbers - num_points;
}

/// The scene of a cloud without a visibility file.
Scene scene_of_bare_cloud(const DenseFiles& files, const Progress& progress,
                          const std::function<void(const std::string&)>& note_that)
{
    ColmapViews model = read_colmap_views(files.model, files.format, progress.part(0.0, 0.1));
    PointCloud cloud = read_ply_cloud(files.cloud, progress.part(0.1, 0.5));
    Scene scene;
    scene.cameras = std::move(model.cameras);
    scene.views = std::move(model.views);
    const KeptSplats kept = keep_solid_splats(cloud);
    note_that(kept.note);
    if (!kept.note.empty() && kept.places.empty()) {
        throw InputError(fmt::format("{}: {}, so none remains", files.cloud.string(), kept.note));
    }
    scene.positions = std::move(cloud.positions);
    std::optional<Tracks> tracks;
    if (files.takes_lists && cloud.splats.empty()) {
        std::string note;
        tracks = tracks_of_lists(cloud.images, model.file_order, scene, note);
        note_that(note);
    }
    take_attributes(std::move(cloud), 0, scene);
    scene.is_dense = !files.are_sparse;
    if (!kept.note.empty()) scene.point_ids = kept.places;
    scene.tracks = tracks ? std::move(*tracks) : nearest_rays(scene, progress.part(0.5, 1.0));
    return scene;
}

} // namespace

DenseSceneReader::DenseSceneReader(const DenseFiles& files, const Progress& progress)
    : DenseSceneReader(files, read_colmap_views(files.model, files.format, progress))
{
}

DenseSceneReader::DenseSceneReader(const DenseFiles& files, ColmapViews model)
    : cloud_(files.cloud),
      visibility_(files.visibility, {cloud_.num_points(), files.cloud}, std::move(model.file_order))
{
    views_.cameras = std::move(model.cameras);
    views_.views = std::move(model.views);
}

Scene DenseSceneReader::next(std::size_t most, const Progress& progress)
{
    Scene part = views_;
    PointCloud cloud = cloud_.next(most, progress.part(0.0, 0.5));
    part.positions = std::move(cloud.positions);
    part.tracks = visibility_.next(most, progress.part(0.5, 1.0));
    take_attributes(std::move(cloud), done_, part);
    done_ += part.num_points();
    return part;
}

Scene read_dense_scene(const DenseFiles& files, const Progress& progress,
                       std::vector<std::string>* notes)
{
    if (files.visibility.empty()) {
        return scene_of_bare_cloud(files, progress, [&](const std::string& note) {
            if (notes == nullptr || note.empty()) return;
            notes->push_back(fmt::format("{}: {}", files.cloud.string(), note));
        });
    }
    DenseSceneReader reader(files, progress.part(0.0, 0.1));
    return reader.next(reader.num_points(), progress.part(0.1, 1.0));
}

std::optional<SceneSize> dense_size_before_reading(const DenseFiles& files)
{
    const PlyHeader header = read_ply_header(files.cloud);
    const PlyElement* const vertices = header.find("vertex");
    if (vertices == nullptr || vertices->count > kMostIndices) return std::nullopt;
    // A list entry has at least one byte
    const auto rays = files.takes_lists ? rays_in(files.cloud, vertices->count)
                      : files.visibility.empty()
                          ? std::optional(kMostNearestViews * vertices->count)
                          : rays_in(files.visibility, vertices->count);
    if (!rays) return std::nullopt;
    const auto model = size_before_reading(files.model, files.format);
    return SceneSize{.points = vertices->count,
                     .rays = *rays,
                     .views = model ? model->views : 0,
                     .has_normals = PlyVertexLayout(*vertices).has_normals(),
                     .is_dense = !files.are_sparse};
}

} // namespace vcarve
