#pragma once

#include "base/log.h"
#include "mesh/removed_faces.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "region/region.h"
#include "steps/6_surface/cleanup.h"
#include "steps/6_surface/face_rules.h"
#include "steps/6_surface/openness.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <memory>
#include <optional>

namespace vcarve {

/// What is wanted of a surface beside what the options say.
struct SurfaceWishes {
    const Region* region = nullptr;  ///< which part of space; null for all
    RemovedFaces* removed = nullptr; ///< gets the faces that are taken away; null where nobody asks
};

/// The faces that were chosen for a surface, before they are mended.
struct SeenSurface {
    TriMesh faces; ///< with TriMesh::points
    /// What they leave open; not known where all faces are kept, or a region leaves some out.
    std::optional<Openness> openness;
};

/// Of the boundary of a labelling (extract.h) the faces that views support (face_rules.h),
/// or all where the surface is to be closed, and of these, where there is a region, those whose
/// corners all lie within it. Throws InputError where no face is left.
SeenSurface seen_surface(const TetMesh& cells, Labels labels, const Scene& scene,
                         const SurfaceWishes& wishes, const SurfaceOptions& options, Log& log);

/// Such faces mended into a manifold (cleanup.h), as the one mesh that is worked on from then on.
/// Small pieces that are dropped go to `removed`, where it is not null.
std::unique_ptr<HalfEdgeMesh> mended_surface(SeenSurface seen, RemovedFaces* removed,
                                             const SurfaceOptions& options, Log& log);

} // namespace vcarve
