#include "vcarve/compare.h"

#include "base/log.h"
#include "base/validate.h"
#include "compare/closed_surface.h"
#include "compare/compare.h"
#include "report/report.h"

#include <nlohmann/json.hpp>

namespace vcarve {

namespace {

Reference reference_of(const Scene& model, const NamedMesh* truth, const CompareOptions& options,
                       Log& log)
{
    Stage stage(log, "reference");
    Reference reference = make_reference(model, truth, options);
    const std::size_t samples = reference.truth ? reference.truth->samples.size() : 0;
    stage.end({{"points", size_of(reference.scene.num_points())},
               {"samples of the truth", size_of(samples)}});
    return reference;
}

/// The numbers in an entry of the JSON text, by their place in it.
std::map<std::string, double> figures_in(const nlohmann::json& entry)
{
    std::map<std::string, double> figures;
    const nlohmann::json flat = entry.flatten();
    for (const auto& [place, value] : flat.items()) {
        if (value.is_number()) figures[place] = value.get<double>();
    }
    return figures;
}

} // namespace

ComparisonReport compare(const Scene& model, std::span<const NamedMesh> meshes,
                         const NamedMesh* truth, const CompareOptions& options, Log& log)
{
    validate(options);
    Reference reference = reference_of(model, truth, options, log);
    add_closed_surface(reference, model, log);
    std::vector<Comparison> comparisons;
    for (const NamedMesh& mesh : meshes) {
        Stage stage(log, "measure");
        comparisons.push_back(compare_mesh(mesh, reference));
        stage.end({{"faces of " + mesh.name, comparisons.back().size.faces}});
    }
    ComparisonReport report;
    report.table = comparison_table(comparisons, reference);
    report.json = comparison_json(comparisons, reference);
    const nlohmann::json record = nlohmann::json::parse(report.json);
    for (const nlohmann::json& entry : record.at("meshes")) {
        report.figures.push_back(figures_in(entry));
    }
    return report;
}

} // namespace vcarve
