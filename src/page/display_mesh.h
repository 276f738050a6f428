#pragma once

#include "base/progress.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// A surface with at most `max_faces` faces to be looked at, or the surface itself where it has no
/// more. Edges are collapsed by meshoptimizer (quadrics of Garland and Heckbert, SIGGRAPH 1997),
/// one end to the other; whether new faces hide what was seen, as --simplify asks, a picture does
/// not need to know. Rims stay as they are. Of what cannot be collapsed any further, such as very
/// many small pieces, evenly chosen faces are left. Vertices keep their places, colours and points;
/// normals go. The result depends on the arguments alone. Throws Cancelled. Cost: about a second a
/// million faces, on one thread.
TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress = {});

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
