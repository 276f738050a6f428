#include "cli/model_input.h"

#include "cli/console_log.h"

#include <utility>

namespace vcarve::cli {

PointsOptions ModelArguments::all_points() const
{
    PointsOptions all = points;
    if (scanner.word == WordOrVector::kNoWord) all.scanner = scanner.vector;
    return all;
}

OptionList input_options(ModelArguments& model)
{
    constexpr const char* kStage = "Input";
    return {
        {kStage,
         {.name = "points",
          .unit = "file",
          .help = "Which points to take: sparse, those of the model; dense, those of fused.ply in "
                  "a dense workspace; or a PLY file with points in the model's frame. By default "
                  "the dense ones where fused.ply and fused.ply.vis are there.",
          .words = {"sparse", "dense"}},
         &model.points.points},
        {kStage,
         {.name = "visibility",
          .help = "Which views saw the points of a PLY file, as COLMAP's stereo_fusion writes it; "
                  "by default the file called like it and .vis."},
         &model.points.visibility},
        {kStage,
         {.name = "sights",
          .help = "Which views saw the points. file: as the model's tracks or the file of "
                  "--visibility say. nearest: that is not known; the nearest views are taken "
                  "before which no other point stands. auto: as file, and as nearest where most "
                  "points of a model have fewer than two views.",
          .words = {"auto", "file", "nearest"}},
         value_of_enum(model.points.sights)},
        {kStage,
         {.name = "scanner",
          .help = "Where the laser scanner stood that measured all points of a PLY file, in its "
                  "coordinates; then no model is needed. file: as it tells itself, for every point "
                  "(x_origin, y_origin, z_origin, or scanner_x ...) or once (PCL's element "
                  "camera).",
          .min = -kUnlimited,
          .words = {"file"}},
         &model.scanner},
    };
}

ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading)
{
    ReadModel read = read_found_model(model.path, model.all_points(), log, reading);
    const FoundModel& found = read.found.model;
    ModelInput input;
    input.record = {{"model", model.path.string()},
                    {"folder", found.folder.string()},
                    {"format", found.format == ModelFormat::binary ? "binary" : "text"},
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
