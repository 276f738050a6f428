#include "cli/shared_work.h"

#include "base/progress.h"
#include "base/stage_counts.h"
#include "cli/run_memory.h"
#include "io/input/find_input.h"
#include "run/job.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <string>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

/// The folder of the photographs.
fs::path photograph_folder(const MeshArguments& arguments)
{
    if (!arguments.texture.images.empty()) return arguments.texture.images;
    return photographs_beside(arguments.model.path).value_or("");
}

/// Everything that the stages depend on. Options such as --offset take effect later.
Job job_of(const MeshArguments& arguments, Log& log)
{
    Stage stage(log, "digest");
    Job job = {program_fact()};
    const Job input =
        input_facts(find_input(arguments.model.path, arguments.model.all_points()), stage);
    job.insert(job.end(), input.begin(), input.end());
    stage.end({{counts::kPlan.files, size_of(input.size())}});
    const Job options = option_facts(arguments.options);
    job.insert(job.end(), options.begin(), options.end());
    if (arguments.tile_points > 0)
        job.push_back({"--tile-points", std::to_string(arguments.tile_points)});
    if (arguments.dense.dense) {
        job.push_back({"--dense-size", std::to_string(arguments.dense.size_px)});
        for (const fs::path& folder : {photograph_folder(arguments), arguments.texture.masks}) {
            const Job facts = photograph_facts(folder, stage);
            job.insert(job.end(), facts.begin(), facts.end());
        }
    }
    return job;
}

} // namespace

std::unique_ptr<WorkFolder> open_work(const MeshArguments& arguments, Log& log)
{
    if (arguments.work.empty()) return nullptr;
    auto folder = std::make_unique<WorkFolder>(arguments.work);
    if (!folder->leads() && arguments.tile_points == 0) { // only tiles can be shared
        throw InputError(fmt::format("another run uses the work folder {}; wait until it ends, or "
                                     "choose another folder with --work",
                                     folder->path().string()));
    }
    folder->begin(job_of(arguments, log));
    return folder;
}

Options options_of_tiles(const MeshArguments& arguments)
{
    Options options = arguments.options;
    options.memory.limit = allowed_memory(options.memory).value_or(0);
    return options;
}

bool has_helped(const MeshArguments& arguments, WorkFolder& work, Log& log)
{
    if (work.leads()) return false;
    const Options options = options_of_tiles(arguments);
    return TiledRun(work, options, log).help();
}

} // namespace vcarve::cli
