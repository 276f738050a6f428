#include "steps/5_labels/boundary.h"

#include "base/index_limit.h"
#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

/// What facets are ordered by.
std::pair<Index, int> key(const CellFacet& facet)
{
    return {facet.cell, facet.slot};
}

} // namespace

std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<CellFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
        if (labels[cell] == Label::outside) {
            return;
        }
        for (int slot = cells.cells[cell].first_bounded_slot(); slot < 4; ++slot) {
            if (labels[cells.cells[cell].neighbors[slot]] == Label::outside) {
                facets.push_back({static_cast<Index>(cell), slot});
            }
        }
    });
}

Face face_of(const TetMesh& cells, const CellFacet& facet)
{
    const auto& corners = cells.cells[facet.cell].vertices;
    const auto& [a, b, c] = kFacetCorners[facet.slot]; // counter-clockwise from inside
    return {corners[a], corners[c], corners[b]};
}

std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets)
{
    const auto found = std::ranges::lower_bound(facets, key(facet), {}, key);
    return static_cast<std::size_t>(found - facets.begin());
}

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets)
{
    require_indexable(facets.size(), kMostFaces, "faces");
    std::vector<Face> faces(facets.size());
    parallel_for(faces.size(), [&](std::size_t i) { faces[i] = face_of(cells, facets[i]); });
    return faces;
}

void close_hull(const TetMesh& cells, Labels& labels)
{
    parallel_for(labels.size(), [&](std::size_t i) {
        if (cells.cells[i].is_infinite()) labels[i] = Label::outside;
    });
}

} // namespace vcarve
