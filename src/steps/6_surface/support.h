#pragma once

#include "mesh/vertex_faces.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <vector>

namespace vcarve {

/// Which faces of a boundary to keep by what the views see. A face is kept if each of its corners
/// was seen from the front of the face by some view of the corner's point, or if some view sees a
/// part of it: nothing that a view sees is dropped for lack of points. Views that stand lower than
/// 3 degrees before a face do not count, but for faces of usual size beside seen ones at two edges,
/// for which one degree will do, lest crests have slits. What no view sees, the shell behind walls
/// and under floors, is not kept, but for small patches amid kept faces. `boundary` is
/// the surface of `facets`, face by face, and needs TriMesh::points. Cost: O(faces + sights), and
/// walks (see FaceVisibility::is_seen) for the faces that the sights of their corners do not speak
/// for; mostly in parallel.
FaceFlags supported_faces(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                          const FaceVisibility& visibility, const Scene& scene,
                          const SupportOptions& options);

/// The faces with a flag; vertices stay.
TriMesh with_faces(TriMesh mesh, const FaceFlags& keep);

} // namespace vcarve
