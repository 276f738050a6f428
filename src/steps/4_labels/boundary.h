#pragma once

#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "model/labels.h"
#include "model/tet_mesh.h"

#include <vector>

namespace vcarve {

/// All facets between an inside and an outside cell, given from the inside one, in the order of the
/// cells. Cost: O(cells), in parallel.
std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels);

/// Where a facet stands among those of a boundary, which are in the order of the cells.
/// Precondition: it is one of them. Cost: O(log facets).
std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets);

/// The facets as faces over the vertices of the cells, counter-clockwise seen from outside. Throws
/// InputError where there are too many to number.
std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets);

/// The boundary of a labelling and how it runs, extracted once and asked by all that judge its
/// faces. Face i is facet i, given from its inside cell, over the vertices of the cells.
/// Cost: O(cells) to build, in parallel.
class Boundary {
  public:
    Boundary(const TetMesh& cells, const Labels& labels);
    Boundary(const Boundary&) = delete;
    Boundary& operator=(const Boundary&) = delete;

    const std::vector<CellFacet>& facets() const { return facets_; }
    /// Which of the facets one is. Precondition: it is one of them. Cost: O(log faces).
    std::size_t number_of(const CellFacet& facet) const;
    const std::vector<Face>& faces() const { return faces_; }
    const LocalEdges& edges() const { return edges_; }
    const SurfaceNormals& normals() const { return normals_; }

  private:
    std::vector<CellFacet> facets_;
    std::vector<Face> faces_;
    LocalEdges edges_;
    SurfaceNormals normals_;
};

} // namespace vcarve
