#include "cli/model_input.h"

#include "cli/console_log.h"

#include <utility>

namespace vcarve::cli {

ModelInput read_model_input(const std::filesystem::path& model, Log& log, const SizeCheck& check)
{
    ReadModel read = read_found_model(model, log, check);
    const FoundModel& found = read.found;
    ModelInput input;
    input.record = {{"model", model.string()},
                    {"folder", found.folder.string()},
                    {"format", found.format == ModelFormat::binary ? "binary" : "text"},
                    {"points", read.scene.num_points()},
                    {"views", read.scene.views.size()},
                    {"sights", read.scene.num_sights()}};
    input.scene = std::move(read.scene);
    return input;
}

std::unique_ptr<Log> shown_log(bool quiet)
{
    if (quiet) return std::make_unique<Log>();
    return std::make_unique<ConsoleLog>(console_on_stderr());
}

} // namespace vcarve::cli
