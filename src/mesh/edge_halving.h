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

/// The longest edge of a face: its two vertices in ascending order. The edge with the lowest vertex
/// numbers wins a tie; lengths that differ only by rounding are equal.
std::array<std::uint32_t, 2> longest_edge_of(std::span<const Eigen::Vector3d> positions,
                                             const Face& face);

/// Bisects edges of a surface together with all their faces, so that no vertex lies inside an edge
/// of another face. Callers choose longest edges (M.-C. Rivara, "Algorithms for refining triangular
/// grids suitable for adaptive and multigrid techniques", IJNME 1984). Unlike there, the other
/// faces of the edge are bisected even if it is not their longest edge. This splits fewer faces,
/// but makes narrower ones. Keeps a reference to the mesh, which nothing else may change meanwhile.
class EdgeHalving {
  public:
    /// A bisected face: one half replaced the face, the other half was appended.
    struct HalvedFace {
        std::uint32_t face;
        std::uint32_t other_half;
    };

    /// Bisects only flagged faces; all if `flags` is empty. `mesh` has no normals. Cost: O(faces).
    EdgeHalving(TriMesh& mesh, const FaceFlags& flags);

    /// Adds the midpoint of an edge (add_midpoint) and bisects the faces of the edge. The half at
    /// `a` replaces the face. Cost: O(faces at the vertices of these faces).
    std::vector<HalvedFace> halve(std::uint32_t a, std::uint32_t b);

    /// Reverts bisections, the latest first, if all their halves are unchanged and
    /// may_join(face, other_half) is true for each pair. Restores the bisected faces. Returns the
    /// obsolete appended halves, unordered, which remain in the mesh. Call this only once, after
    /// all calls of halve().
    template <typename MayJoin>
    std::vector<std::uint32_t> take_back(const MayJoin& may_join);

  private:
    struct Halving {
        std::array<std::uint32_t, 2> edge;
        std::uint32_t middle;
        std::vector<HalvedFace> halved;
        std::vector<Face> whole; ///< these faces before the bisection
    };

    /// The mutable list of faces at a vertex.
    std::vector<std::uint32_t>& faces_at(std::uint32_t vertex);
    bool is_as_left(const Halving& halving) const;

    TriMesh& mesh_;
    std::size_t num_vertices_; ///< before any bisection
    VertexFaces faces_at_first_;
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> faces_at_; ///< if changed
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
