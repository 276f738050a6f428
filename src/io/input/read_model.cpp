#include "io/input/read_model.h"

#include "base/log.h"
#include "io/colmap/model_size.h"

#include <utility>

namespace vcarve {

namespace {

std::optional<SceneSize> expected_size(const FoundInput& found)
{
    if (found.scan) return scan_size_before_reading(*found.scan);
    if (found.dense) return dense_size_before_reading(*found.dense);
    return size_before_reading(found.model.folder, found.model.format);
}

/// Counts the points and sights of the parts that go through it.
class CountedParts final : public SceneParts {
  public:
    explicit CountedParts(SceneParts& parts) : parts_(parts) {}

    std::size_t num_points() const override { return parts_.num_points(); }
    Scene next(std::size_t most, const Progress& progress) override
    {
        Scene part = parts_.next(most, progress);
        sum_.points += part.num_points();
        sum_.sights += part.num_sights();
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

/// A scene, and the size of what it was made of.
using SceneOf = std::pair<Scene, SceneSize>;

SceneOf gathered(SceneParts& parts, const Gather& gather, const Progress& progress)
{
    CountedParts counted(parts);
    Scene scene = gather(counted, progress);
    return {std::move(scene), counted.sum()};
}

Scene whole_scene(const FoundInput& found, const Progress& progress)
{
    if (found.scan) return read_scan_scene(*found.scan, progress);
    if (found.dense) return read_dense_scene(*found.dense, progress);
    return read_colmap_model(found.model.folder, found.model.format, progress);
}

SceneOf scene_of(const FoundInput& found, const Gather& gather, const Progress& progress)
{
    if (gather && found.dense && !found.dense->visibility.empty()) {
        DenseSceneReader reader(*found.dense, progress.part(0.0, 0.1));
        return gathered(reader, gather, progress.part(0.1, 1.0));
    }
    // Else which views saw a point is only known when all points are.
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
    counts.emplace_back("sights", size_of(read.sights));
    stage.end(counts);
}

} // namespace

ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const Reading& reading)
{
    Stage stage(log, "read");
    FoundInput found = find_input(input, options);
    for (const std::string& note : found.notes) {
        log.note(note);
    }
    const auto size = expected_size(found);
    if (reading.check && size) reading.check(*size);
    auto [scene, read] = scene_of(found, reading.gather, stage);
    end_stage(stage, scene, read);
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
