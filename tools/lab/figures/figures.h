#pragma once

#include "figures/paper_case.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vcarve::paper {

using Json = nlohmann::ordered_json;

/// A facet to draw, and its kind.
struct DrawnFacet {
    CellFacet facet; ///< seen from the cell that it closes
    std::string kind;
};

/// The data of a drawing. Each facet has its corners (counterclockwise from outside its cell), its
/// kind, and the cells on both sides (-1 if infinite). scenery() has the positions of corners, and
/// the centers of the cells' circumspheres, which define the order of painting from back to front.
Json panel(const TetMesh& cells, const std::vector<DrawnFacet>& facets);

/// The boundary of a labeling. Facets are "right" if they belong to the true solid, else "wrong".
std::vector<DrawnFacet> judged_boundary(const PaperCase& paper_case, const Labels& labels);

/// The convex hull, with one kind for all facets.
std::vector<DrawnFacet> hull(const TetMesh& cells, const std::string& kind);

/// The positions of an object's points, the centers of its cells' circumspheres (null if missing),
/// and the end points of all edges.
Json scenery(const TetMesh& cells);

// The figures of docs/paper.md as JSON for tools/docs/paper. Panels are those of panel().

/// Figures 15, 16 and 18: the triangulation, and the result of `--method strict`.
Json recovered(const PaperCase& paper_case);

/// Figure 17: the triangulation, and the results with four and with seven views.
Json recovered_in_states(const PaperCase& paper_case);

/// Figures 2 and 3: alpha shapes, including the best.
Json alpha_shapes(const PaperCase& paper_case);

/// Figure 1: the cell that sculpting removes first, and its result.
Json sculpted(const PaperCase& paper_case);

/// Figure 13: for two views that carve the object exactly, the facets in empty space that no ray
/// crosses; they vanish with their cells. Also the largest of them, its cells, and their rays.
Json unmet_triangles(const PaperCase& paper_case);

/// The paper's future work: two views that carve too little, and the result with virtual views. The
/// pair is the one that leaves most, among those that virtual views correct.
Json virtual_viewpoints(const PaperCase& paper_case);

/// The effect of one wrong ray: among all rays that no view has, the one that crosses the most
/// solid cells and no empty ones.
Json drilled(const PaperCase& paper_case);

} // namespace vcarve::paper
