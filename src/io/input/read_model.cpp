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

Scene scene_of(const FoundInput& found, const Progress& progress)
{
    if (found.scan) return read_scan_scene(*found.scan, progress);
    if (found.dense) return read_dense_scene(*found.dense, progress);
    return read_colmap_model(found.model.folder, found.model.format, progress);
}

} // namespace

ReadModel read_found_model(const std::filesystem::path& input, const PointsOptions& options,
                           Log& log, const SizeCheck& check)
{
    Stage stage(log, "read");
    FoundInput found = find_input(input, options);
    for (const std::string& note : found.notes) {
        log.note(note);
    }
    const auto size = expected_size(found);
    if (check && size) check(*size);
    Scene scene = scene_of(found, stage);
    stage.end({{"points", size_of(scene.num_points())},
               {"views", size_of(scene.views.size())},
               {"sights", size_of(scene.num_sights())}});
    return {std::move(scene), std::move(found)};
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
