#include "surface/boundary.h"

#include "surface/extract.h"

namespace vcarve {

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
