#pragma once

#include "mesh/vertices.h"
#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace vcarve {

/// The longest edge of a face: its two vertices, the lower one first; of several as long, but
/// for rounding, that with the lowest numbers.
std::array<std::uint32_t, 2> longest_edge_of(std::span<const Eigen::Vector3d> positions,
                                             const Face& face);

/// Halves edges of a surface together with all faces at them, so that no vertex ever lies inside an
/// edge of another face. Faces are halved at their longest edges as by M.-C. Rivara ("Algorithms
/// for refining triangular grids suitable for adaptive and multigrid techniques", IJNME 1984), but
/// those beside at the same edge, whether it is their longest or not: no more of them than asked
/// for, at the price of narrower ones. Keeps a reference to the mesh, which others may
/// not change meanwhile.
class EdgeHalving {
  public:
    /// A face that was halved: the half at one end of the edge took its place, the other was added.
    struct HalvedFace {
        std::uint32_t face;
        std::uint32_t other_half;
    };

    /// Only the faces with a flag are looked after. `mesh` has no normals. Cost: O(faces).
    EdgeHalving(TriMesh& mesh, const FaceFlags& flags);

    /// Adds the middle of the edge between two vertices (add_midpoint) and halves the faces at it.
    /// Cost: O(faces at the vertices of these).
    std::vector<HalvedFace> halve(std::uint32_t a, std::uint32_t b);

    /// Takes halvings back, the last one first: those of which all halves are still there, and
    /// may_join(face, other_half) says yes for every two. Returns which faces are no more, in no
    /// order; the mesh still holds them, but the halves that took the places of the whole faces are
    /// these again. For once, when nothing is to be halved any more.
    template <typename MayJoin>
    std::vector<std::uint32_t> take_back(const MayJoin& may_join);

  private:
    struct Halving {
        std::array<std::uint32_t, 2> edge;
        std::uint32_t middle;
        std::vector<HalvedFace> halved;
        std::vector<Face> whole; ///< what these faces were
    };

    /// The row of a vertex, to be changed.
    std::vector<std::uint32_t>& faces_at(std::uint32_t vertex);
    bool is_as_left(const Halving& halving) const;

    TriMesh& mesh_;
    std::size_t num_vertices_; ///< at first
    VertexFaces faces_at_first_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> faces_at_; ///< of asked vertices
    std::vector<Halving> done_;
};

template <typename MayJoin>
std::vector<std::uint32_t> EdgeHalving::take_back(const MayJoin& may_join)
{
    std::vector<std::uint32_t> gone;
    for (; !done_.empty(); done_.pop_back()) {
        const Halving& last = done_.back();
        if (!is_as_left(last) || !std::ranges::all_of(last.halved, [&](const HalvedFace& face) {
                return may_join(face.face, face.other_half);
            })) {
            continue;
        }
        for (std::size_t i = 0; i < last.halved.size(); ++i) {
            mesh_.faces[last.halved[i].face] = last.whole[i];
            gone.push_back(last.halved[i].other_half);
        }
    }
    return gone;
}

} // namespace vcarve
