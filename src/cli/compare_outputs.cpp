#include "cli/compare_outputs.h"

#include "base/stage_counts.h"
#include "cli/input_output.h"
#include "compare/comparison_table.h"
#include "io/files/output_file.h"
#include "page/comparison_scene.h"
#include "page/page.h"
#include "page/page_scene.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::cli {

namespace {

namespace fs = std::filesystem;

std::vector<Output> written(const CompareOutputs& outputs)
{
    std::vector<Output> all = {
        {"--json", outputs.json}, {"--preview", outputs.preview.out}, {"--report", outputs.report}};
    std::erase_if(all, [](const Output& output) { return output.path.empty(); });
    return all;
}

Json better_json(Better better)
{
    if (better == Better::neither) return nullptr;
    return better == Better::lower ? "lower" : "higher";
}

Json rows_json(std::span<const Comparison> comparisons, const Reference& reference)
{
    Json rows = Json::array();
    for (const TableRow& row : table_rows(comparisons, reference)) {
        rows.push_back({{"title", row.title},
                        {"place", row.place},
                        {"better", better_json(row.better)},
                        {"cells", row.cells}});
    }
    return rows;
}

} // namespace

std::vector<fs::path> CompareOutputs::paths() const
{
    std::vector<fs::path> paths;
    for (const Output& output : written(*this)) {
        paths.push_back(output.path);
    }
    return paths;
}

OptionList output_options(CompareOutputs& outputs)
{
    constexpr const char* kStage = "Output";
    OptionList options = preview_options(outputs.preview);
    options.insert(options.begin(),
                   {kStage,
                    {.name = "json", .help = "Write all figures, unrounded, as JSON."},
                    &outputs.json});
    options.push_back(
        {kStage,
         {.name = "report",
          .help = "Write a web page with the meshes, OUT.html. It shows them side by side under "
                  "one camera, colored by their distance to the truth or to each other, with the "
                  "table and the largest errors. It needs no network."},
         &outputs.report});
    return options;
}

void check_names(const CompareOutputs& outputs, const ParsedArguments& given)
{
    check_preview(outputs.preview, given);
    if (!outputs.report.empty()) require_page_name(outputs.report);
    require_distinct(written(outputs));
}

void check_outputs(const CompareOutputs& outputs, const RunInput& input,
                   const std::vector<fs::path>& meshes)
{
    std::vector<Output> read;
    read.reserve(meshes.size());
    for (const fs::path& mesh : meshes) {
        read.push_back({"the mesh", mesh});
    }
    keep_inputs(written(outputs), input, read);
    for (const Output& output : written(outputs)) {
        require_writable(output.path);
    }
}

void CompareReport::set_scene(const Scene& scene)
{
    if (out_.empty()) return;
    scene_ = packed_scene(scene);
    offset_ = scene.offset;
}

void CompareReport::add(const std::string& column, const TriMesh& mesh)
{
    if (!out_.empty()) meshes_.push_back({column, mesh});
}

void CompareReport::write(std::span<const Comparison> comparisons, const Reference& reference,
                          const std::string& command, Log& log)
{
    if (out_.empty()) return;
    Stage stage(log, "report");
    const Json scene = comparison_scene(std::move(scene_), offset_, meshes_, reference, stage);
    const Json record = {{"program", program_json()},
                         {"command", command},
                         {"comparison", comparison_record(comparisons, reference)},
                         {"rows", rows_json(comparisons, reference)}};
    OutputFile file(out_);
    write_page(file.stream(), record, scene);
    file.commit();
    stage.end({{counts::kOutput.surfaces, std::ssize(scene["surfaces"])}});
}

} // namespace vcarve::cli
