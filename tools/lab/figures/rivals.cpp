#include "baselines/alpha_shape.h"
#include "baselines/sculpt.h"
#include "figures/figures.h"

#include <algorithm>
#include <cmath>

namespace vcarve::paper {

namespace {

Json judged(const PaperCase& paper_case, const Labels& labels)
{
    const Mistakes found = mistakes_of(paper_case, labels);
    return {{"lost", found.lost},
            {"kept", found.kept},
            {"panel", panel(paper_case.cells, judged_boundary(paper_case, labels))}};
}

struct Tried {
    double alpha;
    Mistakes mistakes;
};

/// All different alpha shapes, from the smallest alpha.
std::vector<Tried> all_alphas(const PaperCase& paper_case)
{
    std::vector<double> radii;
    for (Index cell = 0; cell < paper_case.cells.cells.size(); ++cell) {
        const double radius = circumsphere(paper_case.cells, cell).radius;
        if (std::isfinite(radius)) radii.push_back(radius);
    }
    std::ranges::sort(radii);
    std::vector<Tried> tried;
    for (const double radius : radii) {
        tried.push_back({radius, mistakes_of(paper_case, alpha_shape(paper_case.cells, radius))});
    }
    return tried;
}

Json shape(const PaperCase& paper_case, double alpha)
{
    Json made = judged(paper_case, alpha_shape(paper_case.cells, alpha));
    made["alpha"] = alpha;
    return made;
}

} // namespace

Json alpha_shapes(const PaperCase& paper_case)
{
    const std::vector<Tried> tried = all_alphas(paper_case);
    const auto last_without_kept = std::ranges::find_if(
        tried.rbegin(), tried.rend(), [](const Tried& t) { return t.mistakes.kept == 0; });
    const auto best = std::ranges::min_element(
        tried, {}, [](const Tried& t) { return t.mistakes.lost + t.mistakes.kept; });
    const auto first_without_lost =
        std::ranges::find_if(tried, [](const Tried& t) { return t.mistakes.lost == 0; });
    const auto right = std::ranges::count_if(
        tried, [](const Tried& t) { return t.mistakes.lost == 0 && t.mistakes.kept == 0; });
    return {{"object", paper_case.name},
            {"tried", tried.size()},
            {"right", right},
            {"nothing_kept", shape(paper_case, last_without_kept->alpha)},
            {"fewest", shape(paper_case, best->alpha)},
            {"whole", shape(paper_case, smallest_whole_alpha(paper_case.cells))},
            {"nothing_lost", shape(paper_case, first_without_lost->alpha)}};
}

Json sculpted(const PaperCase& paper_case)
{
    const TetMesh& cells = paper_case.cells;
    const Labels first = sculpt(cells, 1);
    Index taken = 0;
    while (cells.cells[taken].is_infinite() || first[taken] == Label::inside) {
        ++taken;
    }
    std::vector<DrawnFacet> start = hull(cells, "hull");
    for (DrawnFacet& drawn : start) {
        if (drawn.facet.cell == taken) drawn.kind = "wrong";
    }
    Json made = judged(paper_case, sculpt(cells));
    made["object"] = paper_case.name;
    made["solid_cells"] = std::ranges::count(paper_case.truth, Label::inside);
    made["empty_cells"] = mistakes_of(paper_case, sculpt(cells, 0)).kept;
    made["first_is_solid"] = paper_case.truth[taken] == Label::inside;
    made["start"] = panel(cells, start);
    made["truth"] = panel(cells, judged_boundary(paper_case, paper_case.truth));
    return made;
}

} // namespace vcarve::paper
