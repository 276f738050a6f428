#pragma once

#include "model/scene.h"
#include "model/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

using FaceFlags = std::vector<std::uint8_t>; ///< one a face, 0 or 1

/// Unit, pointing outside; not finite where the face has no area.
Eigen::Vector3d face_normal(const TriMesh& mesh, const Face& face);

/// Which faces have been seen: each corner by some view of its point's track that the face turns
/// its front to, at under about 87 degrees. Needs TriMesh::points. Cost: O(sights), in parallel.
FaceFlags seen_faces(const TriMesh& mesh, const Scene& scene);

/// Per face, how many views of its track saw the least seen corner from the front of the face: what
/// seen_faces wants to be 1 or more. 0 where a corner is no point. Needs TriMesh::points. Cost:
/// O(faces x views of their points), in parallel.
std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene);

/// The longest edge of each face.
std::vector<double> longest_edges(const TriMesh& mesh);

/// The longest edge of each face over the median edge around it, of the measured faces only, at its
/// middle corner: not at the one that knows only the face itself, nor at the one in the densest
/// place. Infinite or NaN where no face around is measured. Cost: O(faces), mostly in parallel.
std::vector<double> relative_sizes(const TriMesh& mesh, const FaceFlags& measured);

} // namespace vcarve
