#include "io/input/read_model.h"

#include "base/progress.h"
#include "io/colmap/colmap_model.h"
#include "io/colmap/model_files.h"
#include "io/input/complete_rays.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace vcarve {

namespace {

std::optional<SceneSize> expected_size(const FoundInput& found)
{
    if (found.scan) return scan_size_before_reading(*found.scan);
    if (found.dense) return dense_size_before_reading(*found.dense);
    return size_before_reading(found.model.folder, found.model.format);
}

/// Passes parts on, and counts their points and rays.
class CountedParts final : public SceneParts {
  public:
    explicit CountedParts(SceneParts& parts) : parts_(parts) {}

    std::size_t num_points() const override { return parts_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override
    {
        Scene part = parts_.next(most, progress);
        sum_.points += part.num_points();
        sum_.rays += part.num_rays();
        sum_.views = part.views.size();
        sum_.has_normals = sum_.has_normals || !part.normals.empty();
        sum_.is_dense = true;
        return part;
    }
    const SceneSize& sum() const { return sum_; }

  private:
    SceneParts& parts_;
    SceneSize sum_;
};

/// A scene, and the size of the input it was made from.
using SceneOf = std::pair<Scene, SceneSize>;

SceneOf gathered(SceneParts& parts, const Gather& gather, const Progress& progress)
{
    CountedParts counted(parts);
    Scene scene = gather(counted, progress);
    return {std::move(scene), counted.sum()};
}

std::string file_of(const FoundInput& found, const char* stem)
{
    return model_path(found.model.folder, stem, found.model.format).string();
}

/// Throws InputError with a remedy if there are no views or no points.
void require_points_and_views(const FoundInput& found, const SceneSize& read)
{
    if (read.views == 0 && !found.scan) {
        throw InputError(fmt::format("{}: has no images, so the cameras that saw the points are "
                                     "unknown; use the model that COLMAP's mapper or "
                                     "image_undistorter wrote",
                                     file_of(found, "images")));
    }
    if (read.points > 0) return;
    if (found.scan) throw InputError(found.scan->cloud.string() + ": has no points");
    if (found.dense) {
        throw InputError(fmt::format("{}: has no points; run stereo_fusion with a smaller "
                                     "--StereoFusion.min_num_pixels or better depth maps, or use "
                                     "the points of the model (--points sparse)",
                                     found.dense->cloud.string()));
    }
    throw InputError(fmt::format("{}: has no points; colmap point_triangulator computes points if "
                                 "poses are known",
                                 file_of(found, "points3D")));
}

/// Reads the points of the model. Adds notes about the source of their rays.
Scene sparse_scene(FoundInput& found, const Progress& progress)
{
    DroppedRays dropped;
    Scene scene = read_colmap_model(found.model.folder, found.model.format, progress.part(0.0, 0.9),
                                    &dropped);
    const std::string warning = warning_of_poses(scene, file_of(found, "images"));
    // Points may project beyond the edges of cropped images.
    if (!warning.empty() && !points2d_agree(found.model.folder, found.model.format, scene)) {
        found.notes.push_back(warning);
    }
    std::ranges::move(complete_rays(found, dropped, scene, progress.part(0.9, 1.0)),
                      std::back_inserter(found.notes));
    return scene;
}

/// Reads the points of a cloud. Adds notes about dropped points and possible errors.
Scene dense_scene(FoundInput& found, const Progress& progress)
{
    Scene scene = read_dense_scene(*found.dense, progress, &found.notes);
    if (!found.dense->visibility.empty()) return scene;
    const std::string warning =
        warning_of_frames(scene, found.dense->cloud, file_of(found, "images"));
    if (!warning.empty()) found.notes.push_back(warning);
    return scene;
}

Scene whole_scene(FoundInput& found, const Progress& progress)
{
    if (found.scan) return read_scan_scene(*found.scan, progress);
    if (found.dense) return dense_scene(found, progress);
    return sparse_scene(found, progress);
}

SceneOf scene_of(FoundInput& found, const Gather& gather, const Progress& progress)
{
    if (gather && found.dense && !found.dense->visibility.empty()) {
        DenseSceneReader reader(*found.dense, progress.part(0.0, 0.1));
        return gathered(reader, gather, progress.part(0.1, 1.0));
    }
    // Otherwise the views of a point are known only after all points are read.
    const bool is_cloud = found.scan || found.dense;
    Scene scene = whole_scene(found, gather && is_cloud ? progress.part(0.0, 0.6) : progress);
    if (gather && scene.is_dense) {
        PartsOfScene parts(scene);
        return gathered(parts, gather, progress.part(0.6, 1.0));
    }
    const SceneSize size = size_of(scene);
    return {std::move(scene), size};
}

void end_stage(Stage& stage, const Scene& scene, const SceneSize& read)
{
    Counts counts = {{"points", size_of(scene.num_points())}};
    if (read.points != scene.num_points()) counts.emplace_back("of", size_of(read.points));
    counts.emplace_back("views", size_of(scene.views.size()));
    counts.emplace_back("rays", size_of(read.rays));
    stage.end(counts);
}

} // namespace

ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const Reading& reading)
{
    Stage stage(log, "read");
    FoundInput found = find_input(input, options);
    const auto report = [&](std::size_t first) {
        std::for_each(found.notes.begin() + static_cast<std::ptrdiff_t>(first), found.notes.end(),
                      [&](const std::string& note) { log.note(note); });
    };
    report(0);
    const std::size_t told = found.notes.size();
    const auto size = expected_size(found);
    if (reading.check && size) reading.check(*size);
    auto [scene, read] = scene_of(found, reading.gather, stage);
    require_points_and_views(found, read);
    std::ranges::move(forget_unknown_values(scene), std::back_inserter(found.notes));
    end_stage(stage, scene, read);
    report(told);
    return {std::move(scene), read, std::move(found)};
}

Scene read_model(const std::filesystem::path& input, const PointsOptions& options, Log& log)
{
    return read_found_model(input, options, log).scene;
}

Scene read_model(const std::filesystem::path& input, Log& log)
{
    return read_model(input, {}, log);
}

} // namespace vcarve
