#pragma once

#include "base/progress.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstdint>
#include <span>
#include <vector>

namespace vcarve {

/// Simplifies a surface to at most `max_faces` faces for display; smaller surfaces are returned
/// unchanged. meshoptimizer collapses each edge to one of its vertices (quadrics of Garland and
/// Heckbert, SIGGRAPH 1997). Unlike --simplify, this does not check occlusion of points. Boundary
/// edges stay. If collapses do not suffice, as with very many small components, evenly chosen faces
/// remain. Vertices keep their positions, colors and points; normals are dropped. The result
/// depends on the arguments alone. Throws Cancelled. Cost: about 1 s per million faces, serial.
TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress = {});

/// Returns the number n of parts that the edges of each face are split into, so that no part is
/// longer than `length`: a power of two up to 64. A face becomes n x n small faces. `length` is
/// doubled until there are at most `most` small faces, or until no face is split. Precondition:
/// length > 0.
std::vector<std::int32_t> edge_parts(const TriMesh& mesh, double length, std::int64_t most);

/// Returns the corners of these small faces, face by face, without the corners of the faces. A face
/// with n parts has the positions c0 + i / n (c1 - c0) + j / n (c2 - c0), with i from 0 to n in the
/// outer loop and j from 0 to n - i in the inner loop.
std::vector<Eigen::Vector3d> grid_places(const TriMesh& mesh, std::span<const std::int32_t> parts);

} // namespace vcarve
