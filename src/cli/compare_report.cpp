#include "cli/compare_report.h"

#include "compare/comparison_table.h"
#include "io/files/output_file.h"
#include "page/comparison_scene.h"
#include "page/page.h"
#include "page/page_scene.h"

namespace vcarve::cli {

namespace {

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

void CompareReport::stand_in(const Scene& scene)
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
    stage.end({{"surfaces shown", std::ssize(scene["surfaces"])}});
}

} // namespace vcarve::cli
