#include "compare/compare.h"

#include "base/progress.h"
#include "base/stage_counts.h"
#include "compare/comparison_table.h"
#include "compare/evidence.h"
#include "options/declared.h"

namespace vcarve {

namespace {

/// The known figures of a mesh, by their JSON pointers.
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

std::optional<std::int64_t> genus(const MeshCheck& check)
{
    const bool sound = check.is_closed() && check.is_manifold() && check.orientation_faults == 0 &&
                       check.degenerate_faces == 0;
    if (!sound) return std::nullopt;
    return check.components - check.euler_characteristic / 2;
}

Reference complete_reference(Scene model, const NamedMesh* truth, const CompareOptions& options,
                             Log& log)
{
    Stage stage(log, "reference");
    Reference reference = make_reference(model, truth, options);
    const std::size_t samples = reference.truth ? reference.truth->samples.size() : 0;
    stage.end({{counts::kCompare.points, size_of(reference.scene.num_points())},
               {counts::kCompare.samples, size_of(samples)}});
    add_closed_surface(reference, std::move(model), log);
    return reference;
}

Comparison compare_mesh(const NamedMesh& named, const Reference& reference, Log& log)
{
    Stage stage(log, "measure");
    const MeasuredMesh mesh = place_mesh(named, reference);
    Comparison comparison;
    comparison.name = named.name;
    comparison.size = check_mesh(mesh.mesh);
    comparison.genus = genus(comparison.size);
    comparison.evidence = measure_against_views(mesh, reference);
    if (reference.truth) comparison.truth = measure_against_truth(mesh, reference);
    stage.end({{counts::kCompare.faces, comparison.size.faces, kNoTotal, named.name}});
    return comparison;
}

ComparisonReport compare(const Scene& model, std::span<const NamedMesh> meshes,
                         const NamedMesh* truth, const CompareOptions& options, Log& log)
{
    validate(options);
    const Reference reference = complete_reference(model, truth, options, log);
    std::vector<Comparison> comparisons;
    for (const NamedMesh& mesh : meshes) {
        comparisons.push_back(compare_mesh(mesh, reference, log));
    }
    ComparisonReport report;
    report.table = comparison_table(comparisons, reference);
    report.json = comparison_json(comparisons, reference);
    const std::vector<Figure> judged_by = figures(reference, {});
    for (const Comparison& comparison : comparisons) {
        report.figures.push_back(known_figures(comparison, judged_by));
    }
    return report;
}

} // namespace vcarve
