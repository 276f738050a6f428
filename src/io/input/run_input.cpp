#include "io/input/run_input.h"

#include "vcarve/error.h"

#include <fmt/format.h>

#include <utility>

namespace vcarve {

namespace fs = std::filesystem;

RunInput resolve_input(const fs::path& path, const PointsOptions& points, const Options& options,
                       bool needs_views, Log& log)
{
    RunInput input = {.path = path, .found = find_input(path, points), .views = {}, .images = {}};
    const FoundModel& model = input.found.model;
    const bool needs_images = reads_photographs(options) || !options.masks.folder.empty();
    if (needs_images && input.found.scan) {
        throw InputError(fmt::format("{}: a laser scan has no photographs; leave out --dense, "
                                     "--texture, --images and --masks",
                                     input.found.scan->cloud.string()));
    }
    if (!needs_images && (!needs_views || model.folder.empty())) return input;
    ColmapViews read = read_colmap_views(model.folder, model.format);
    input.views.cameras = std::move(read.cameras);
    input.views.views = std::move(read.views);
    input.file_order = std::move(read.file_order);
    if (needs_images) input.images = find_images(input.views, options, model.folder, log);
    return input;
}

} // namespace vcarve
