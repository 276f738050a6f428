#include "compare/figures.h"

#include "model/views.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace vcarve {
namespace {

using Value = Figure::Value;

constexpr const char* kShare = "{:.4f}";

/// A member of `whole`, or unknown.
template <typename Whole, typename Member>
Value known(const std::optional<Whole>& whole, Member member)
{
    return whole ? Value((*whole).*member) : Value();
}

Figure size_figure(const char* key, const char* title, std::int64_t MeshCheck::*member,
                   Better better = Better::neither)
{
    return {.place = fmt::format("/size/{}", key),
            .title = title,
            .better = better,
            .value = [member](const Comparison& c) { return c.size.*member; }};
}

std::vector<Figure> size_figures()
{
    return {
        size_figure("vertices", "vertices", &MeshCheck::vertices),
        size_figure("faces", "faces", &MeshCheck::faces),
        {.place = "/size/area",
         .title = "area",
         .value = [](const Comparison& c) { return c.size.area; },
         .format = "{:.5g}"},
        size_figure("components", "components", &MeshCheck::components),
        size_figure("boundary_edges", "boundary edges", &MeshCheck::boundary_edges),
        size_figure("nonmanifold_edges", "non-manifold edges", &MeshCheck::nonmanifold_edges,
                    Better::lower),
        size_figure("nonmanifold_vertices", "non-manifold vertices",
                    &MeshCheck::nonmanifold_vertices, Better::lower),
        size_figure("orientation_faults", "orientation faults", &MeshCheck::orientation_faults,
                    Better::lower),
        size_figure("degenerate_faces", "degenerate faces", &MeshCheck::degenerate_faces,
                    Better::lower),
        size_figure("unreferenced_vertices", "unreferenced vertices",
                    &MeshCheck::unreferenced_vertices, Better::lower),
        {.place = "/size/genus",
         .title = "genus",
         .value = [](const Comparison& c) { return c.genus ? Value(*c.genus) : Value(); },
         .when_unknown = "open",
         .meaning = "genus: number of handles; open: the surface is not closed and manifold."},
    };
}

Figure view_figure(const char* key, const char* title, double EvidenceFigures::*member,
                   std::string meaning)
{
    return {.place = fmt::format("/views/{}", key),
            .title = title,
            .better = Better::lower,
            .value = [member](const Comparison& c) { return c.evidence.*member; },
            .format = kShare,
            .meaning = std::move(meaning)};
}

std::vector<Figure> view_figures(const Reference& reference)
{
    const double k = reference.options.spacings;
    return {
        view_figure("hidden_rays", "hidden rays", &EvidenceFigures::hidden_rays,
                    fmt::format("hidden rays: fraction of rays from a point to a view that saw it "
                                "that hit the mesh farther than {} spacings from the point.",
                                k)),
        view_figure(
            "missed_points", "missed points", &EvidenceFigures::missed_points,
            fmt::format("missed points: fraction of points more than {} spacings from the mesh.",
                        k)),
        view_figure("unsupported_area", "unsupported area", &EvidenceFigures::unsupported_area,
                    "unsupported area: fraction of the mesh's area that no view sees from its "
                    "front (inside the image, unoccluded)."),
        view_figure("median_distance", "median distance [spacings]",
                    &EvidenceFigures::median_distance, ""),
        {.place = "/views/seen_boundary_edges",
         .title = "seen boundary edges",
         .better = Better::lower,
         .value = [](const Comparison& c) { return c.evidence.seen_boundary_edges; },
         .meaning = "seen boundary edges: boundary edges whose midpoint a view sees (inside the "
                    "image, unoccluded)."},
        {.place = "/views/back_faces_seen",
         .title = "back faces seen",
         .better = Better::lower,
         .value =
             [](const Comparison& c) {
                 return known(c.evidence.rays, &RayFigures::back_faces_seen);
             },
         .format = kShare,
         .meaning = fmt::format("back faces seen: fraction of {} rays, in a regular grid in every "
                                "image, that hit the mesh from behind first.",
                                reference.rays.size())},
        {.place = "/views/nothing_seen",
         .title = "nothing seen",
         .better = Better::lower,
         .value =
             [](const Comparison& c) {
                 const bool is_known = c.evidence.rays && c.evidence.rays->nothing_seen;
                 return is_known ? Value(*c.evidence.rays->nothing_seen) : Value();
             },
         .format = kShare,
         .meaning = reference.closed_hits
                        ? "nothing seen: fraction of these rays that miss the mesh but hit the "
                          "closed surface, which --closed makes of the model."
                        : "nothing seen: unknown, because the model has no closed surface."},
    };
}

Figure agreement_figure(std::size_t i, const char* key, const char* word, double Agreement::*member)
{
    const bool has_row = word[0] != '\0';
    return {.place = fmt::format("/truth/agreement/{}/{}", i, key),
            .title = has_row ? fmt::format("{} {} %", word, 100.0 * kTolerances[i]) : "",
            .better = has_row ? Better::higher : Better::neither,
            .value =
                [i, member](const Comparison& c) {
                    return c.truth ? Value(c.truth->agreements[i].*member) : Value();
                },
            .format = kShare};
}

Figure truth_figure(const char* key, const char* title, double TruthFigures::*member)
{
    return {.place = fmt::format("/truth/{}", key),
            .title = title,
            .better = Better::lower,
            .value = [member](const Comparison& c) { return known(c.truth, member); },
            .format = kShare};
}

Figure line_figure(const char* name, const char* key, Better better, double LineFigures::*member)
{
    return {.place = fmt::format("/truth/{}", key),
            .title = name,
            .better = better,
            .value =
                [member](const Comparison& c) {
                    return c.truth ? known(c.truth->lines, member) : Value();
                },
            .format = kShare};
}

Figure normal_figure(const char* key, const char* title, double NormalFigures::*member)
{
    return {.place = fmt::format("/truth/{}", key),
            .title = title,
            .better = Better::lower,
            .value =
                [member](const Comparison& c) {
                    return c.truth ? known(c.truth->normals, member) : Value();
                },
            .format = "{:.2f}"};
}

std::vector<Figure> truth_figures(const Reference& reference)
{
    std::vector<Figure> all;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        all.push_back(agreement_figure(i, "tolerance", "", &Agreement::tolerance));
        all.push_back(agreement_figure(i, "f", "F", &Agreement::f_score));
        all.push_back(agreement_figure(i, "precision", "precision", &Agreement::precision));
        all.push_back(agreement_figure(i, "recall", "recall", &Agreement::recall));
    }
    all[1].meaning = fmt::format(
        "precision: fraction of {} area samples of the mesh within this part of the diagonal of "
        "the truth; recall: of the truth's samples, this near to the mesh; F: harmonic mean.",
        reference.options.samples);
    all.push_back(truth_figure("mean_accuracy", "mean accuracy [%]", &TruthFigures::mean_accuracy));
    all.back().scale = 100.0;
    all.back().meaning = "accuracy, completeness: mean distance of the mesh's samples to the truth "
                         "and vice versa, in % of the diagonal.";
    all.push_back(truth_figure("mean_completeness", "mean completeness [%]",
                               &TruthFigures::mean_completeness));
    all.back().scale = 100.0;
    all.push_back(truth_figure("blocked", "blocked", &TruthFigures::blocked));
    all.back().meaning =
        "blocked: fraction of the truth's samples whose line to a random view that sees them hits "
        "the mesh farther than 1 % of the diagonal from the sample.";
    all.push_back(
        line_figure("seen right", "seen_right", Better::higher, &LineFigures::seen_right));
    all.back().meaning = fmt::format(
        "seen right, torn, open: fractions of rays from a random view through a sample of the "
        "truth in its image, and beyond ({} of {} samples have one). Seen right: first hit a "
        "front, at most 0.5 % of the diagonal before or behind the sample. Torn: first hit a back. "
        "Open: miss the mesh.",
        reference.truth->image_samples(), reference.truth->samples.size());
    all.push_back(line_figure("torn", "torn", Better::lower, &LineFigures::torn));
    all.push_back(line_figure("open", "open", Better::lower, &LineFigures::open));
    all.push_back(normal_figure("median_normal_error_deg", "median normal error [deg]",
                                &NormalFigures::median_deg));
    all.back().meaning =
        "normal error: angle between the normals of the mesh and of the nearest face "
        "of the truth, regardless of orientation, over the mesh's samples at most 1 % "
        "of the diagonal from the truth.";
    all.push_back(
        normal_figure("p90_normal_error_deg", "90 % normal error [deg]", &NormalFigures::most_deg));
    return all;
}

std::vector<Figure> cost_figures()
{
    return {
        {.place = "/cost/seconds",
         .title = "seconds",
         .better = Better::lower,
         .value = [](const Comparison& c) { return known(c.cost, &RunCost::seconds); },
         .format = "{:.2f}",
         .meaning = "seconds, CPU seconds (all threads), peak memory: of the program that made the "
                    "mesh, from start to end, on this machine."},
        {.place = "/cost/cpu_seconds",
         .title = "CPU seconds",
         .better = Better::lower,
         .value = [](const Comparison& c) { return known(c.cost, &RunCost::cpu_seconds); },
         .format = "{:.2f}"},
        {.place = "/cost/peak_memory_bytes",
         .title = "peak memory [MB]",
         .better = Better::lower,
         .value = [](const Comparison& c) { return known(c.cost, &RunCost::peak_memory_bytes); },
         .format = "{:.1f}",
         .scale = 1e-6},
    };
}

} // namespace

std::optional<double> Figure::number(const Comparison& comparison) const
{
    const Value known = value(comparison);
    if (const auto* count = std::get_if<std::int64_t>(&known)) return static_cast<double>(*count);
    if (const auto* real = std::get_if<double>(&known)) return *real;
    return std::nullopt;
}

std::string Figure::shown(const Comparison& comparison) const
{
    const Value known = value(comparison);
    if (const auto* count = std::get_if<std::int64_t>(&known); count != nullptr && scale == 1.0)
        return fmt::format(fmt::runtime(format), *count);
    const std::optional<double> real = number(comparison);
    return real ? fmt::format(fmt::runtime(format), scale * *real) : when_unknown;
}

std::vector<Figure> figures(const Reference& reference, std::span<const Comparison> comparisons)
{
    std::vector<Figure> all = size_figures();
    const auto append = [&](std::vector<Figure> more) {
        std::ranges::move(more, std::back_inserter(all));
    };
    append(view_figures(reference));
    if (reference.truth) append(truth_figures(reference));
    if (has_costs(comparisons)) append(cost_figures());
    return all;
}

bool has_costs(std::span<const Comparison> comparisons)
{
    return std::ranges::any_of(comparisons,
                               [](const Comparison& c) { return c.cost || !c.failure.empty(); });
}

std::vector<std::string> definitions(const Reference& reference, const std::vector<Figure>& figures)
{
    const bool is_scan = has_scanners(reference.scene);
    std::vector<std::string> lines = {fmt::format(
        "Measured against {} points with at least {} and {} views; spacing of a "
        "point = distance to its 6th nearest point.",
        reference.scene.num_points(), is_scan ? "2 views or a measured range" : "2 views",
        reference.scene.views.size())};
    if (reference.truth) {
        lines.push_back(fmt::format("truth: {} area samples of the part visible from at least {} "
                                    "(unoccluded, less than 80 degrees from the normal, inside "
                                    "the image or not; {:.1f} % of its area), seed {}; diagonal "
                                    "of their box: {:.6g}.",
                                    reference.truth->samples.size(),
                                    is_scan ? "one view" : "3 views",
                                    100.0 * reference.truth->seen_share, reference.options.seed,
                                    reference.truth->diagonal));
    }
    for (const Figure& figure : figures) {
        if (!figure.meaning.empty()) lines.push_back(figure.meaning);
    }
    return lines;
}

} // namespace vcarve
