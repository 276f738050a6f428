#include "figures/figures.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/carve_surface.h"
#include "vcarve/reconstruct.h"

#include <algorithm>

namespace vcarve::paper {

namespace {

/// As the program does it, all of its stages.
TriMesh made_by_program(const Scene& scene)
{
    Options options;
    options.labels.method = Method::strict;
    Log silent;
    return reconstruct(scene, options, silent).mesh;
}

/// What there is, and whether the true solid came out.
Json facts(const PaperCase& paper_case, const TriMesh& surface)
{
    const auto finite = std::ranges::count_if(paper_case.cells.cells,
                                              [](const Cell& cell) { return !cell.is_infinite(); });
    return {{"object", paper_case.name},
            {"points", paper_case.scene.num_points()},
            {"views", paper_case.scene.views.size()},
            {"sights", paper_case.scene.num_sights()},
            {"cells", finite},
            {"faces", surface.faces.size()},
            {"true_faces", paper_case.solid.faces.size()},
            {"area", area_of(surface)},
            {"true_area", area_of(paper_case.solid)},
            {"volume", volume_of(surface)},
            {"true_volume", volume_of(paper_case.solid)},
            {"exact", is_exact(surface, paper_case.solid)}};
}

/// The object as some of its views carve it.
Json state(const PaperCase& paper_case, std::size_t count)
{
    const Scene scene = seen_by(paper_case.scene, views_that_open_most(paper_case, count));
    const Labels labels = carve(paper_case.cells, crossings_of(paper_case.cells, scene), 1);
    const Mistakes found = mistakes_of(paper_case, labels);
    return {{"views", count},
            {"sights", scene.num_sights()},
            {"left", found.kept},
            {"left_volume", found.kept_volume},
            {"exact", is_exact(extract_surface(paper_case.cells, labels, scene), paper_case.solid)},
            {"panel", panel(paper_case.cells, judged_boundary(paper_case, labels))}};
}

} // namespace

Json recovered(const PaperCase& paper_case)
{
    Json made = facts(paper_case, made_by_program(paper_case.scene));
    made["delaunay"] = panel(paper_case.cells, hull(paper_case.cells, "hull"));
    made["strict"] = panel(paper_case.cells, judged_boundary(paper_case, paper_case.truth));
    return made;
}

Json recovered_in_states(const PaperCase& paper_case)
{
    Json made = recovered(paper_case);
    made["states"] = {state(paper_case, 4), state(paper_case, 7)};
    return made;
}

} // namespace vcarve::paper
