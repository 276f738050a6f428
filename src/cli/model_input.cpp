#include "cli/model_input.h"

#include "cli/console_log.h"
#include "io/colmap/model_size.h"

namespace vcarve::cli {

ModelInput read_model_input(const std::filesystem::path& model, Log& log, const SizeCheck& check)
{
    Stage stage(log, "read");
    const FoundModel found = find_model(model);
    for (const std::string& note : found.notes) {
        log.note(note);
    }
    const auto size = size_before_reading(found.folder, found.format);
    if (check && size) check(*size);
    ModelInput input;
    input.scene = read_colmap_model(found.folder, found.format);
    const Counts counts = {{"points", input.scene.num_points()},
                           {"views", input.scene.views.size()},
                           {"sights", input.scene.num_sights()}};
    input.record = {{"model", model.string()},
                    {"folder", found.folder.string()},
                    {"format", found.format == ModelFormat::binary ? "binary" : "text"}};
    for (const auto& [name, count] : counts) {
        input.record[name] = count;
    }
    stage.end(counts);
    return input;
}

std::unique_ptr<Log> shown_log(bool quiet)
{
    if (quiet) return std::make_unique<Log>();
    return std::make_unique<ConsoleLog>(console_on_stderr());
}

} // namespace vcarve::cli
