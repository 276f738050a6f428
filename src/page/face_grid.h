#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Into how many parts the edges of each face are cut so that none is longer than a length: as many
/// as the face's longest edge needs, a power of two up to 64. The length is `length`, doubled as
/// often as it takes until all faces together fall into no more than `most` small faces, n x n of n
/// parts, or until none is cut. Precondition: length > 0.
std::vector<std::int32_t> edge_parts(const TriMesh& mesh, double length, std::int64_t most);

/// The corners of those small faces, face by face, without the faces' own corners: of a face of n
/// parts, at (i, j) the place c0 + i / n (c1 - c0) + j / n (c2 - c0), for i from 0 to n, and for
/// each j from 0 to n - i.
std::vector<Eigen::Vector3d> grid_places(const TriMesh& mesh, std::span<const std::int32_t> parts);

} // namespace vcarve
