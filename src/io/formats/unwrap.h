#pragma once

#include "model/photograph.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace vcarve {

/// A textured surface in which every vertex has one place in one page, as formats want it whose
/// corners share vertices: where charts meet there are several vertices in one place. Vertices and
/// faces go page by page, and else keep their order.
struct UnwrappedMesh {
    TriMesh mesh;                        ///< without colours, which would darken the texture
    std::vector<Eigen::Vector2f> places; ///< of the vertices in their page, see Texture
    std::vector<std::size_t> begins{0};  ///< page i has the faces begins[i] up to begins[i + 1]
};

/// Cost: O(faces log(faces)).
UnwrappedMesh unwrap(const TriMesh& mesh, const Texture& texture);

} // namespace vcarve
