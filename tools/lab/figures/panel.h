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

} // namespace vcarve::paper
