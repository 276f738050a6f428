#include "io/colmap/read_model.h"

#include "base/log.h"
#include "io/colmap/model_size.h"

#include <utility>

namespace vcarve {

ReadModel read_found_model(const std::filesystem::path& input, Log& log, const SizeCheck& check)
{
    Stage stage(log, "read");
    FoundModel found = find_model(input);
    for (const std::string& note : found.notes) {
        log.note(note);
    }
    const auto size = size_before_reading(found.folder, found.format);
    if (check && size) check(*size);
    Scene scene = read_colmap_model(found.folder, found.format, stage);
    stage.end({{"points", size_of(scene.num_points())},
               {"views", size_of(scene.views.size())},
               {"sights", size_of(scene.num_sights())}});
    return {std::move(scene), std::move(found)};
}

Scene read_model(const std::filesystem::path& input, Log& log)
{
    return read_found_model(input, log).scene;
}

} // namespace vcarve
