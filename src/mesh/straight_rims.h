#pragma once

#include "mesh/vertex_faces.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vcarve {

/// Which faces lie in one plane: those of one number. kNoPlane says nothing of a face.
using PlaneOf = std::function<std::uint32_t(std::uint32_t face)>;
inline constexpr std::uint32_t kNoPlane = 0xffffffffU;

/// Takes vertices out of straight stretches of the rim of the faces with a flag, so that these have
/// fewer faces and edges at the rim and cover exactly what they did: a vertex from `first_vertex`
/// on goes if all its faces lie in one plane and its two neighbours on the rim stand on a line with
/// it, unless a face would turn round or lose its area, or an edge be made that is there. Its faces
/// then reach to one of these neighbours, and the one that would have no area goes. Faces before
/// `first_face` may change but never go; where they would have to, the vertex stays. Flags are
/// taken off those that go, which are returned in no order. Vertices stay where they are. Cost:
/// O(faces), and for the vertices in question O(faces at their neighbours), a few times.
std::vector<std::uint32_t> straighten_rims(std::uint32_t first_vertex, std::uint32_t first_face,
                                           const PlaneOf& plane_of, TriMesh& mesh, FaceFlags& keep);

} // namespace vcarve
