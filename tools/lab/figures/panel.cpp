#include "figures/panel.h"

#include "baselines/circumsphere.h"
#include "steps/5_labels/boundary.h"

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

} // namespace vcarve::paper
