#pragma once

#include "base/options.h"
#include "mesh/vertex_faces.h"
#include "model/scene.h"
#include "model/tri_mesh.h"
#include "steps/3_visibility/face_visibility.h"

#include <vector>

namespace vcarve {

struct SupportOptions {
    double max_gap_edge = 3.0;

    void visit(OptionVisitor& options)
    {
        options.number(max_gap_edge,
                       {.name = "max-gap-edge",
                        .unit = "x local edge",
                        .help = "Keep a few faces that no view sees amid seen ones if no edge is "
                                "this many times longer than the median around; 0 keeps none."});
    }
};

/// Which faces of a boundary to keep by what the views see. A face is kept if each of its corners
/// was seen from the front of the face by some view of the corner's point, or if some view sees a
/// part of it: nothing that a view sees is dropped for lack of points. What no view sees, the shell
/// behind walls and under floors, is not kept, but for small patches amid kept faces. `boundary` is
/// the surface of `facets`, face by face, and needs TriMesh::points. Cost: O(faces + sights), and
/// walks (see FaceVisibility::is_seen) for the faces that the sights of their corners do not speak
/// for; mostly in parallel.
FaceFlags supported_faces(const TriMesh& boundary, const std::vector<CellFacet>& facets,
                          const FaceVisibility& visibility, const Scene& scene,
                          const SupportOptions& options);

/// The faces with a flag; vertices stay.
TriMesh with_faces(TriMesh mesh, const FaceFlags& keep);

} // namespace vcarve
