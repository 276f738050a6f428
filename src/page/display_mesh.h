#pragma once

#include "base/progress.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>

namespace vcarve {

/// A surface with at most `max_faces` faces to be looked at, or the surface itself where it has no
/// more. Edges are collapsed as --simplify does it (Garland and Heckbert, SIGGRAPH 1997, by
/// OpenMesh's decimater), one end to the other, but whether new faces hide what was seen is not
/// asked: that takes most of the time there, and a picture does not need it. Of what cannot
/// be collapsed any further, such as very many small pieces, evenly chosen faces are left. Vertices
/// keep their places, colours and points. The result depends on the arguments alone.
/// Throws Cancelled. Cost: O(faces log faces), mostly on one thread.
TriMesh display_mesh(const TriMesh& mesh, std::int64_t max_faces, const Progress& progress = {});

} // namespace vcarve
