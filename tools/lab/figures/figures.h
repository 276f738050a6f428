#pragma once

#include "figures/paper_case.h"

#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace vcarve::paper {

using Json = nlohmann::ordered_json;

/// A facet to be drawn, and what for.
struct DrawnFacet {
    CellFacet facet; ///< seen from the cell that it closes
    std::string kind;
};

/// What a picture is drawn from: for each facet its corners, counter-clockwise seen from outside
/// its cell, its kind, and the cells on its two sides, of which infinite ones are -1. The places of
/// corners, and the centres of the cells' spheres, by which they are painted from back to front,
/// are those of scenery().
Json panel(const TetMesh& cells, const std::vector<DrawnFacet>& facets);

/// The boundary of a labelling, each facet "right" or "wrong": whether it is one of the true
/// solid's.
std::vector<DrawnFacet> judged_boundary(const PaperCase& paper_case, const Labels& labels);

/// The convex hull, all of one kind.
std::vector<DrawnFacet> hull(const TetMesh& cells, const std::string& kind);

/// The places of an object's points and the centres of its cells' spheres, null where there is
/// none, and the ends of all edges.
Json scenery(const TetMesh& cells);

// The figures of docs/paper.md as JSON for tools/docs/paper. Panels are those of panel().

/// Figures 15, 16 and 18: the triangulation, and what `--method strict` makes of it.
Json recovered(const PaperCase& paper_case);

/// Figure 17: the triangulation, and what is left with four views and with seven.
Json recovered_in_states(const PaperCase& paper_case);

/// Figures 2 and 3: alpha shapes, the best among them.
Json alpha_shapes(const PaperCase& paper_case);

/// Figure 1: the cell that sculpting takes first, and what it leaves in the end.
Json sculpted(const PaperCase& paper_case);

/// Figure 13: with two views that carve the object exactly, the facets in empty space that no sight
/// crosses, which go because their cells do; and the largest of them with its cells and what
/// crosses these.
Json unmet_triangles(const PaperCase& paper_case);

/// The paper's future work: of two views that leave too much, what virtual ones find. The pair is
/// the one that leaves most of those that are mended.
Json virtual_viewpoints(const PaperCase& paper_case);

/// What one wrong sight does: of all that no view has, the one that drills through most cells of
/// the solid and none of empty space.
Json drilled(const PaperCase& paper_case);

} // namespace vcarve::paper
