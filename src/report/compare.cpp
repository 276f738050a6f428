#include "vcarve/compare.h"

#include "base/log.h"
#include "compare/closed_surface.h"
#include "compare/compare.h"
#include "options/declared.h"
#include "report/figures.h"
#include "report/report.h"

#include <optional>

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

/// The figures of a mesh that are known, by their places in the JSON text.
std::map<std::string, double> known_figures(const Comparison& comparison,
                                            const std::vector<Figure>& figures)
{
    std::map<std::string, double> known;
    for (const Figure& figure : figures) {
        const std::optional<double> number = figure.number(comparison);
        if (number) known[figure.place] = *number;
    }
    return known;
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
    const std::vector<Figure> judged_by = figures(reference, false);
    for (const Comparison& comparison : comparisons) {
        report.figures.push_back(known_figures(comparison, judged_by));
    }
    return report;
}

} // namespace vcarve
