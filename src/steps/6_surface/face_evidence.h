#pragma once

#include "mesh/local_shape.h"
#include "mesh/vertices.h"
#include "model/tet_mesh.h"
#include "model/usual_values.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// The boundary of a labeling. Face i of the surface is facet i, and facets ascend.
struct Boundary {
    const TriMesh& surface;
    const std::vector<CellFacet>& facets;
    const FaceVisibility& visibility;
    UsualValues* usual = nullptr;
};

/// Whether some view sees a position on a facet, if only kept faces block it. The cosine of the
/// angle between ray and normal must be above `cosine`; 0 accepts grazing rays. Cost: one walk per
/// view in front of the facet, until one sees it.
bool is_seen(const Boundary& boundary, const FaceFlags& keep, const CellFacet& facet,
             const Eigen::Vector3d& place, double cosine);

/// Observations about each face of the boundary that the rules need (face_rules.h): its size and
/// dihedral angle relative to the surface around, the views that see it, and what is behind it.
/// `keep` flags the present faces. It may change between calls, which changes visibility and
/// boundaries. Edge lengths and normals are those of the faces that were kept initially. Keeps
/// references. Thread-safe unless `keep` changes.
class FaceEvidence {
  public:
    FaceEvidence(const Boundary& boundary, const FaceFlags& keep);

    /// All faces at each vertex, kept or not.
    const VertexFaces& faces_at() const { return faces_at_; }
    /// The longest edge of a face.
    double length(std::uint32_t face) const { return edges_.longest_edge(face); }
    /// The longest edge over the median edge around the face (LocalEdges::relative_size).
    double relative_size(std::uint32_t face) const { return edges_.relative_size(face); }
    /// The median longest edge of the faces kept initially.
    double usual_length() const { return usual_length_; }

    /// Whether the face continues the small faces around one of its corners; otherwise it bends
    /// away. It also bends away if no corner has small faces. A face in front of an infinite cell
    /// continues the surface, since continue_along_hull() already tested this.
    bool continues_surface(std::uint32_t face) const
    {
        return boundary_.visibility.is_before_infinity(boundary_.facets[face]) ||
               vcarve::continues_surface(face, normals_);
    }

    /// Whether it is a rim face: on the convex hull, or beside a dropped face.
    bool is_at_rim(std::uint32_t face) const;
    /// Whether it shares an edge with a kept face.
    bool is_beside_kept(std::uint32_t face) const;

    /// Whether views see less than a share of its samples, if only kept faces block them. False if
    /// images are unreliable (FaceVisibility::has_reliable_visibility). Cost: a walk per sample and
    /// view until the result is certain, also for hides_back().
    bool is_seen_less_than(double share, std::uint32_t face) const;

    /// Whether removing the face would expose the back of a kept face to a view.
    bool hides_back(std::uint32_t face) const;

  private:
    Boundary boundary_;
    const FaceFlags& keep_;
    VertexFaces faces_at_;
    LocalEdges edges_;
    SurfaceNormals normals_;
    double usual_length_ = 0.0;
};

} // namespace vcarve
