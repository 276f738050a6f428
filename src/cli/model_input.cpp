#include "cli/model_input.h"

#include "cli/console_log.h"

#include <array>
#include <utility>

namespace vcarve::cli {

namespace {

void visit(SightsFrom& sights, OptionVisitor& options)
{
    static constexpr std::array<const char*, 2> kNames = {"file", "nearest"};
    options.choice(sights, kNames,
                   {.name = "sights",
                    .help = "Where it is known from which views saw the points of a PLY file. "
                            "file: from the file of --visibility. nearest: from nowhere; the "
                            "nearest views are taken before which no other point stands."});
}

void visit_scanner(WordOrVector& scanner, OptionVisitor& options)
{
    static constexpr std::array<const char*, 1> kWords = {"file"};
    options.word_or_vector(
        scanner, kWords,
        {.name = "scanner",
         .help = "Where the laser scanner stood that measured all points of a PLY file, in its "
                 "coordinates; then no model is needed. file: as it tells itself, for every point "
                 "(x_origin, y_origin, z_origin, or scanner_x ...) or once (PCL's element camera).",
         .min = -kUnlimited});
}

} // namespace

void list_points_options(OptionTable& table)
{
    table.stage("Input");
    table.path({.name = "points",
                .help = "Which points to take: sparse, those of the model; dense, those of "
                        "fused.ply in a dense workspace; or a PLY file with points in the model's "
                        "frame. By default the dense ones where fused.ply and fused.ply.vis are "
                        "there."});
    table.path({.name = "visibility",
                .help = "Which views saw the points of a PLY file, as COLMAP's stereo_fusion "
                        "writes it; by default the file called like it and .vis."});
    SightsFrom sights = SightsFrom::file;
    visit(sights, table);
    WordOrVector scanner;
    visit_scanner(scanner, table);
}

PointsOptions read_points_options(const ParsedArguments& given)
{
    PointsOptions options;
    if (given.has("points")) options.points = given.options.at("points");
    if (given.has("visibility")) options.visibility = given.options.at("visibility");
    OptionReader reader(given);
    visit(options.sights, reader);
    WordOrVector scanner;
    visit_scanner(scanner, reader);
    if (scanner.word == WordOrVector::kNoWord) options.scanner = scanner.vector;
    return options;
}

ModelInput read_model_input(const ModelArguments& model, Log& log, const Reading& reading)
{
    ReadModel read = read_found_model(model.path, model.points, log, reading);
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

std::unique_ptr<RunLog> shown_log(bool quiet)
{
    if (quiet) return std::make_unique<RunLog>();
    return std::make_unique<ConsoleLog>(console_on_stderr());
}

} // namespace vcarve::cli
