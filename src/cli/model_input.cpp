#include "cli/model_input.h"

#include "cli/console_log.h"

#include <array>
#include <utility>

namespace vcarve::cli {

ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading)
{
    ReadModel read = read_found_model(model.path, model.all_points(), log, reading);
    const FoundModel& found = read.found.model;
    constexpr std::array kFormats = {"binary", "text", "transforms"};
    ModelInput input;
    input.record = {{"model", model.path.string()},
                    {"folder", found.folder.string()},
                    {"format", kFormats.at(static_cast<std::size_t>(found.format))},
                    {"cloud", nullptr},
                    {"points", read.read.points},
                    {"views", read.read.views},
                    {"sights", read.read.sights}};
    if (read.found.scan) input.record["cloud"] = read.found.scan->cloud.string();
    if (read.found.scan && found.folder.empty()) {
        input.record["folder"] = nullptr;
        input.record["format"] = nullptr;
    }
    if (read.found.dense) input.record["cloud"] = read.found.dense->cloud.string();
    input.scene = std::move(read.scene);
    input.read = read.read;
    return input;
}

std::unique_ptr<RunLog> shown_log(bool quiet, bool verbose)
{
    if (quiet) return std::make_unique<RunLog>();
    return std::make_unique<ConsoleLog>(console_on_stderr(verbose));
}

} // namespace vcarve::cli
