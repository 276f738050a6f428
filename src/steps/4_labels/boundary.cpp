#include "steps/4_labels/boundary.h"

#include "base/index_limit.h"
#include "base/parallel.h"

#include <algorithm>
#include <utility>

namespace vcarve {

std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<CellFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
        if (labels[cell] == Label::outside) {
            return;
        }
        for (int slot = 0; slot < 4; ++slot) {
            if (labels[cells.cells[cell].neighbors[slot]] == Label::outside) {
                facets.push_back({static_cast<Index>(cell), slot});
            }
        }
    });
}

std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets)
{
    const auto key = [](const CellFacet& f) { return std::pair(f.cell, f.slot); };
    const auto found = std::ranges::lower_bound(facets, key(facet), {}, key);
    return static_cast<std::size_t>(found - facets.begin());
}

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets)
{
    require_indexable(facets.size(), kMostFaces, "faces");
    std::vector<Face> faces(facets.size());
    parallel_for(faces.size(), [&](std::size_t i) {
        const auto& corners = cells.cells[facets[i].cell].vertices;
        const auto& [a, b, c] = kFacetCorners[facets[i].slot]; // counter-clockwise from inside
        faces[i] = {corners[a], corners[c], corners[b]};
    });
    return faces;
}

Boundary::Boundary(const TetMesh& cells, const Labels& labels)
    : facets_(boundary_facets(cells, labels)),
      faces_(boundary_faces(cells, facets_)),
      edges_(cells.positions, faces_),
      normals_(cells.positions, faces_, edges_)
{
}

std::size_t Boundary::number_of(const CellFacet& facet) const
{
    return place_of(facet, facets_);
}

} // namespace vcarve
