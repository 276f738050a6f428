#pragma once

#include "base/log.h"
#include "model/scene.h"
#include "model/tri_mesh.h"
#include "pipeline/options.h"

namespace vcarve {

/// A surface and the scene it was made from: the points that passed the filter, in the order
/// TriMesh::points counts them, centred.
struct Reconstruction {
    Scene scene;
    TriMesh mesh;
};

/// From a scene to its surface: the steps in order, on `options.threads` threads; the result does
/// not depend on how many. Throws InputError where the scene holds too little for a surface, and
/// before any work where it would need more than `options.max_memory`.
Reconstruction reconstruct(Scene input, const Options& options, Log& log);

} // namespace vcarve
