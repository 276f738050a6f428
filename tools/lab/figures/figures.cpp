#include "figures/figures.h"

#include "baselines/alpha_shape.h"
#include "steps/5_labels/boundary.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/carve_surface.h"
#include "vcarve/reconstruct.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace vcarve::paper {

namespace {

Json place(const Eigen::Vector3d& at)
{
    return {at.x(), at.y(), at.z()};
}

Json finite_cell(const TetMesh& cells, Index cell)
{
    return cells.cells[cell].is_infinite() ? Json(-1) : Json(cell);
}

/// Runs all stages of the program.
TriMesh made_by_program(const Scene& scene)
{
    Options options;
    options.labels.method = Method::strict;
    Log silent;
    return reconstruct(scene, options, silent).mesh;
}

/// Sizes of the object, and whether the surface is the true solid.
Json facts(const PaperCase& paper_case, const TriMesh& surface)
{
    const auto finite = std::ranges::count_if(paper_case.cells.cells,
                                              [](const Cell& cell) { return !cell.is_infinite(); });
    return {{"object", paper_case.name},
            {"points", paper_case.scene.num_points()},
            {"views", paper_case.scene.views.size()},
            {"rays", paper_case.scene.num_rays()},
            {"cells", finite},
            {"faces", surface.faces.size()},
            {"true_faces", paper_case.solid.faces.size()},
            {"area", area_of(surface)},
            {"true_area", area_of(paper_case.solid)},
            {"volume", volume_of(surface)},
            {"true_volume", volume_of(paper_case.solid)},
            {"exact", is_exact(surface, paper_case.solid)}};
}

/// The object carved with its first `count` views.
Json state(const PaperCase& paper_case, std::size_t count)
{
    const Scene scene = seen_by(paper_case.scene, views_that_open_most(paper_case, count));
    const Labels labels = carve(paper_case.cells, crossings_of(paper_case.cells, scene), 1);
    const Mistakes found = mistakes_of(paper_case, labels);
    return {{"views", count},
            {"rays", scene.num_rays()},
            {"left", found.kept},
            {"left_volume", found.kept_volume},
            {"exact", is_exact(extract_surface(paper_case.cells, labels, scene), paper_case.solid)},
            {"panel", panel(paper_case.cells, judged_boundary(paper_case, labels))}};
}

} // namespace

Json panel(const TetMesh& cells, const std::vector<DrawnFacet>& facets)
{
    Json drawn = Json::array();
    for (const auto& [facet, kind] : facets) {
        const Face face = face_of(cells, facet);
        drawn.push_back({face[0], face[1], face[2], kind, finite_cell(cells, facet.cell),
                         finite_cell(cells, cells.other_side(facet).cell)});
    }
    return drawn;
}

std::vector<DrawnFacet> judged_boundary(const PaperCase& paper_case, const Labels& labels)
{
    std::vector<DrawnFacet> drawn;
    for (const CellFacet& facet : boundary_facets(paper_case.cells, labels)) {
        const Index beyond = paper_case.cells.other_side(facet).cell;
        const bool is_right = paper_case.truth[facet.cell] == Label::inside &&
                              paper_case.truth[beyond] == Label::outside;
        drawn.push_back({facet, is_right ? "right" : "wrong"});
    }
    return drawn;
}

std::vector<DrawnFacet> hull(const TetMesh& cells, const std::string& kind)
{
    Labels labels(cells.cells.size(), Label::inside);
    close_hull(cells, labels);
    std::vector<DrawnFacet> drawn;
    for (const CellFacet& facet : boundary_facets(cells, labels)) {
        drawn.push_back({facet, kind});
    }
    return drawn;
}

Json scenery(const TetMesh& cells)
{
    Json made = {{"points", Json::array()}, {"centers", Json::array()}, {"edges", Json::array()}};
    for (const Eigen::Vector3d& position : cells.positions) {
        made["points"].push_back(place(position));
    }
    std::set<std::pair<Index, Index>> edges;
    for (Index cell = 0; cell < cells.cells.size(); ++cell) {
        const Circumsphere sphere = circumsphere(cells, cell);
        made["centers"].push_back(std::isfinite(sphere.radius) ? place(sphere.center) : Json());
        if (cells.cells[cell].is_infinite()) continue;
        for (const Index a : cells.cells[cell].vertices) {
            for (const Index b : cells.cells[cell].vertices) {
                if (a < b) edges.insert({a, b});
            }
        }
    }
    for (const auto& [a, b] : edges) {
        made["edges"].push_back({a, b});
    }
    return made;
}

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
