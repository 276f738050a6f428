#include "io/input/read_model.h"

#include "base/progress.h"
#include "base/stage_counts.h"
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

/// Reads a sample of the points of the model.
PointSample sample_of(const FoundModel& model, const Progress& progress, DroppedRays& dropped)
{
    constexpr std::size_t kPart = 100'000;
    PointSample sample;
    Scene frame = read_colmap_parts(
        model.folder, model.format, kPart, [&](const Scene& part) { sample.add(part); }, progress,
        &dropped);
    sample.scene.cameras = std::move(frame.cameras);
    sample.scene.views = std::move(frame.views);
    return sample;
}

/// Adds notes about the poses, and about the source of the rays.
void complete(FoundInput& found, const DroppedRays& dropped, Scene& scene, const Progress& progress)
{
    const std::string warning = warning_of_poses(scene, file_of(found, "images"));
    // Points may project beyond the edges of cropped images.
    if (!warning.empty() && !points2d_agree(found.model.folder, found.model.format, scene)) {
        found.notes.push_back(warning);
    }
    std::ranges::move(complete_rays(found, dropped, scene, progress),
                      std::back_inserter(found.notes));
}

/// Reads the points of the model, or a sample.
ReadModel sparse_model(FoundInput found, bool wants_sample, const Progress& progress)
{
    const Progress reading = progress.part(0.0, 0.9);
    ReadModel read;
    DroppedRays dropped;
    if (wants_sample) {
        PointSample sample = sample_of(found.model, reading, dropped);
        if (!lacks_rays(found, sample.scene)) {
            read.one_in = sample.one_in;
            read.scene = std::move(sample.scene);
            read.read = size_of(read.scene);
            read.read.points = sample.points;
            read.read.rays = sample.rays;
            complete(found, dropped, read.scene, progress.part(0.9, 1.0));
            read.found = std::move(found);
            return read;
        }
        dropped = {};
    }
    read.scene = read_colmap_model(found.model.folder, found.model.format, reading, &dropped);
    complete(found, dropped, read.scene, progress.part(0.9, 1.0));
    read.read = size_of(read.scene);
    read.found = std::move(found);
    return read;
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

SceneOf cloud_of(FoundInput& found, const Gather& gather, const Progress& progress)
{
    if (gather && found.dense && !found.dense->visibility.empty()) {
        DenseSceneReader reader(*found.dense, progress.part(0.0, 0.1));
        return gathered(reader, gather, progress.part(0.1, 1.0));
    }
    // Otherwise the views of a point are known only after all points are read.
    const Progress reading = gather ? progress.part(0.0, 0.6) : progress;
    Scene scene = found.scan ? read_scan_scene(*found.scan, reading) : dense_scene(found, reading);
    if (gather) {
        PartsOfScene parts(scene);
        return gathered(parts, gather, progress.part(0.6, 1.0));
    }
    const SceneSize size = size_of(scene);
    return {std::move(scene), size};
}

ReadModel read_found(FoundInput found, const std::optional<SceneSize>& size, const Reading& reading,
                     const Progress& progress)
{
    if (!found.scan && !found.dense) {
        const bool wants_sample = reading.wants_sample && reading.wants_sample(size);
        return sparse_model(std::move(found), wants_sample, progress);
    }
    auto [scene, read] = cloud_of(found, reading.gather, progress);
    return {std::move(scene), read, std::move(found)};
}

void end_stage(Stage& stage, const ReadModel& model)
{
    const SceneSize& read = model.read;
    const std::size_t points = model.one_in > 1 ? read.points : model.scene.num_points();
    const std::int64_t all = read.points == points ? kNoTotal : size_of(read.points);
    stage.end({{counts::kRead.points, size_of(points), all},
               {counts::kRead.views, size_of(model.scene.views.size())},
               {counts::kRead.rays, size_of(read.rays)}});
}

} // namespace

ReadModel read_found_model(FoundInput found, Log& log, const Reading& reading)
{
    Stage stage(log, "read");
    const auto report = [&](const std::vector<std::string>& notes, std::size_t first) {
        std::for_each(notes.begin() + static_cast<std::ptrdiff_t>(first), notes.end(),
                      [&](const std::string& note) { log.note(note); });
    };
    report(found.notes, 0);
    const std::size_t reported = found.notes.size();
    const auto size = expected_size(found);
    if (reading.check && size) reading.check(*size);
    ReadModel model = read_found(std::move(found), size, reading, stage);
    require_points_and_views(model.found, model.read);
    std::ranges::move(forget_unknown_values(model.scene), std::back_inserter(model.found.notes));
    end_stage(stage, model);
    report(model.found.notes, reported);
    return model;
}

void read_points(const ReadModel& model, std::size_t most, const TakePoints& take,
                 const Progress& progress)
{
    if (model.one_in == 1) {
        PartsOfScene parts(model.scene);
        for (std::size_t left = model.scene.num_points(); left > 0; left -= std::min(left, most)) {
            take(parts.next(most, progress));
        }
        return;
    }
    const bool knows_errors =
        std::ranges::any_of(model.scene.errors_px, [](double error) { return error >= 0.0; });
    const auto take_part = [&](Scene part) {
        if (!knows_errors) part.errors_px.assign(part.num_points(), -1.0);
        take(std::move(part));
    };
    const FoundModel& found = model.found.model;
    read_colmap_parts(found.folder, found.format, most, take_part, progress);
}

Scene read_model(const std::filesystem::path& input, const PointsOptions& options, Log& log)
{
    return read_found_model(find_input(input, options), log).scene;
}

Scene read_model(const std::filesystem::path& input, Log& log)
{
    return read_model(input, {}, log);
}

} // namespace vcarve
