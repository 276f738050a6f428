#pragma once

#include "mesh/half_edge_mesh.h"
#include "mesh/removed_faces.h"
#include "mesh/vertex_faces.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Keeps account of which faces are taken away and why, where somebody wants to know; otherwise it
/// does nothing and costs nothing.
class Removals {
  public:
    /// `wanted` is what the faces are added to; null where nobody wants them.
    explicit Removals(RemovedFaces* wanted) : wanted_(wanted) {}

    /// Of the faces of a boundary, those that have lost their flag since the last time lost it for
    /// this reason; those that have got it back are not taken away.
    void note(const FaceFlags& keep, Removal reason);
    /// Adds the faces that were noted. `boundary` is what the flags are of.
    void add_noted(const TriMesh& boundary);
    /// Adds the faces before `end` that were deleted: small pieces.
    void add_deleted(const HalfEdgeMesh& mesh, std::size_t end);

  private:
    static constexpr std::uint8_t kKept = 0xff;

    RemovedFaces* wanted_;
    std::vector<std::uint8_t> why_; ///< per face of the boundary: the reason, or kKept
};

} // namespace vcarve
