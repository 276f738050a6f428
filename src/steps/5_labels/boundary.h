#pragma once

#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "model/labels.h"
#include "model/tet_mesh.h"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

/// All facets between an inside and an outside cell, given from the inside one, in the order of the
/// cells; those between two infinite cells, which have no end, are left out. Cost: O(cells), in
/// parallel.
std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels);

/// The corners of a facet, counter-clockwise seen from outside its cell.
Face face_of(const TetMesh& cells, const CellFacet& facet);

/// Where a facet stands among those of a boundary, which are in the order of the cells.
/// Precondition: it is one of them. Cost: O(log facets).
std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets);

/// The facets as faces over the vertices of the cells, counter-clockwise seen from outside. Throws
/// InputError where there are too many to number.
std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets);

/// The boundary of a labelling and how it runs, extracted once and asked by all that judge its
/// faces. Face i is facet i, given from its inside cell, over the vertices of the cells; at first
/// they are in the order of the cells. Where a few labels change, it can be updated: faces keep
/// their numbers, also those that are gone, which come back by the same ones, and new faces take
/// the next. The faces at a vertex stay in the order of the cells, so that what is measured there
/// is the same, to the last bit, as were the boundary extracted anew. Keeps a reference to the
/// cells. Cost: O(cells) to build, in parallel.
class Boundary {
  public:
    Boundary(const TetMesh& cells, const Labels& labels);
    Boundary(const Boundary&) = delete;
    Boundary& operator=(const Boundary&) = delete;

    /// Makes this the boundary of other labels, which differ from those before in `changed_cells`
    /// only. Cost: O(changed cells x log faces), and once the copy of all facets to a larger place.
    /// Not while others ask.
    void update(const Labels& labels, std::span<const Index> changed_cells);

    /// By number, with those that are gone.
    const std::vector<CellFacet>& facets() const { return facets_; }
    const std::vector<Face>& faces() const { return faces_; }
    /// Whether a face is not gone.
    bool is_there(std::uint32_t face) const { return !gone_.contains(face); }
    /// Which of the facets one is. Precondition: it is one of them. Cost: O(log faces).
    std::size_t number_of(const CellFacet& facet) const { return *find(facet); }
    /// The facets that are there, in the order of the cells. Cost: O(faces).
    std::vector<CellFacet> facets_in_order() const;

    const LocalEdges& edges() const { return edges_; }
    const SurfaceNormals& normals() const { return normals_; }

  private:
    std::optional<std::uint32_t> find(const CellFacet& facet) const;
    std::uint32_t find_or_add(const CellFacet& facet);
    bool is_before(std::uint32_t a, std::uint32_t b) const;

    const TetMesh& cells_;
    std::vector<CellFacet> facets_;
    std::vector<Face> faces_;
    std::size_t num_first_; ///< how many facets there were at first, in order
    std::map<std::pair<Index, int>, std::uint32_t> added_; ///< the numbers of the others
    std::set<std::uint32_t> gone_; ///< the numbers of those that no label makes a boundary now
    LocalEdges edges_;
    SurfaceNormals normals_;
};

} // namespace vcarve
