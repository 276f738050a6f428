#pragma once

#include "model/labels.h"
#include "model/tet_mesh.h"
#include "surface/local_edges.h"
#include "surface/surface_normals.h"

#include <vector>

namespace vcarve {

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
