#pragma once

#include "mesh/vertex_faces.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// Whether some view of a point's track sees it from the side the unit normal points to, at under
/// about 87 degrees.
bool is_seen_from_front(const Scene& scene, std::uint32_t point, const Eigen::Vector3d& normal);

/// Whether a face over points of the scene has been seen: each corner by some view of its point's
/// track that the face turns its front to.
bool is_seen(const Scene& scene, const Face& points, const Eigen::Vector3d& normal);

/// Which faces have been seen at all corners, by is_seen(). Needs TriMesh::points. Cost: O(sights),
/// in parallel.
FaceFlags faces_seen_at_corners(const TriMesh& mesh, const Scene& scene);

/// Per face, how many views of its track saw the least seen corner from the front of the face: what
/// faces_seen_at_corners wants to be 1 or more. 0 where a corner is no point. Needs
/// TriMesh::points. Cost: O(faces x views of their points), in parallel.
std::vector<std::int32_t> face_supports(const TriMesh& mesh, const Scene& scene);

} // namespace vcarve
