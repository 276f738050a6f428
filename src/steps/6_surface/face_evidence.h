#pragma once

#include "mesh/local_shape.h"
#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The boundary of a labelling: face i of its surface is facet i, and these ascend.
struct Boundary {
    const TriMesh& surface;
    const std::vector<CellFacet>& facets;
    const FaceVisibility& visibility;
};

/// Whether some view sees a place on a facet at an angle whose cosine to the normal is above
/// `cosine` (0: a graze counts, too), where only kept faces block the view. Cost: a walk for each
/// view before the facet, until one sees it.
bool is_seen(const Boundary& boundary, const FaceFlags& keep, const CellFacet& facet,
             const Eigen::Vector3d& place, double cosine);

/// What is known of each face of a boundary when it is decided whether it is surface
/// (face_rules.h): how large it is beside the surface around, how it turns off that, what views see
/// of it, and what lies behind. `keep` says which faces are there; it may change between questions,
/// and answers about what views see follow. How long edges are and how the surface runs is told by
/// the faces that are kept at first. Keeps references. Safe from many threads as long as none
/// changes what is kept.
class FaceEvidence {
  public:
    FaceEvidence(const Boundary& boundary, const FaceFlags& keep);

    /// The faces at each vertex, kept or not.
    const VertexFaces& faces_at() const { return faces_at_; }
    /// The longest edge of a face.
    double length(std::uint32_t face) const { return edges_.longest_edge(face); }
    /// The same over the median edge around the face (LocalEdges::relative_size).
    double relative_size(std::uint32_t face) const { return edges_.relative_size(face); }
    /// The length of the median face that is kept at first.
    double usual_length() const { return usual_length_; }

    /// Whether the face goes on with the small faces around one of its corners; else it turns off.
    /// Where no corner has small faces it turns off, too. A face before infinity goes on with what
    /// it was called inside for (go_on_along_hull).
    bool goes_on(std::uint32_t face) const
    {
        return boundary_.visibility.is_before_infinity(boundary_.facets[face]) ||
               vcarve::goes_on(face, normals_);
    }

    /// Whether the surface ends at the face: it faces infinity, or a face beside it is not kept.
    bool surface_ends_at(std::uint32_t face) const;
    /// Whether a kept face lies beside it.
    bool is_beside_kept(std::uint32_t face) const;

    /// Whether views see less than a share of the places on the face, through what is kept. Never
    /// where images do not tell (FaceVisibility::is_told_by_images). Cost: a walk for each place
    /// and view, until it is decided; so of those below.
    bool is_seen_less_than(double share, std::uint32_t face) const;

    /// Whether a view would look onto the back of a kept face, were this one away.
    bool hides_a_back(std::uint32_t face) const;

  private:
    Boundary boundary_;
    const FaceFlags& keep_;
    VertexFaces faces_at_;
    LocalEdges edges_;
    SurfaceNormals normals_;
    double usual_length_ = 0.0;
};

} // namespace vcarve
