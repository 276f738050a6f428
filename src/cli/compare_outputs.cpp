#include "cli/compare_outputs.h"

#include "cli/outputs.h"
#include "io/files/output_file.h"
#include "page/page.h"
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
                    {.name = "json", .help = "Also write all figures, unrounded, as JSON."},
                    &outputs.json});
    options.push_back(
        {kStage,
         {.name = "report",
          .help = "Also write a page for browsers, OUT.html, that needs no network: the surfaces "
                  "side by side under one camera, coloured by their distance to the truth or to "
                  "each other, the table, and the worst places to go to."},
         &outputs.report});
    return options;
}

void check_names(const CompareOutputs& outputs, const ParsedArguments& given)
{
    check_preview(outputs.preview, given);
    if (!outputs.report.empty()) require_page_name(outputs.report);
    require_distinct(written(outputs));
}

void check_outputs(const CompareOutputs& outputs, const ModelArguments& model,
                   const std::vector<fs::path>& meshes)
{
    std::vector<Output> read;
    read.reserve(meshes.size());
    for (const fs::path& mesh : meshes) {
        read.push_back({"the mesh", mesh});
    }
    keep_inputs(written(outputs), model, read);
    for (const Output& output : written(outputs)) {
        require_writable(output.path);
    }
}

} // namespace vcarve::cli
