#pragma once

#include "base/log.h"
#include "mesh/removed_faces.h"
#include "steps/1_points/region.h"
#include "steps/4_labels/labelling.h"
#include "steps/5_surface/cleanup.h"
#include "steps/5_surface/sheets.h"
#include "steps/5_surface/support.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <memory>

namespace vcarve {

/// What is wanted of a surface beside what the options say.
struct SurfaceWishes {
    const Region* region = nullptr;  ///< which part of space; null for all
    RemovedFaces* removed = nullptr; ///< gets the faces that are taken away; null where nobody asks
};

/// The surface of a labelling: the boundary of the inside (extract.h), of which only the faces are
/// kept that views support (support.h, sheets.h) unless it is to be closed, and of these, where
/// there is a region, those whose corners all lie within it; mended into a manifold (cleanup.h), as
/// the one mesh that is worked on from then on. Throws InputError where no face is left.
std::unique_ptr<HalfEdgeMesh> make_surface(Labelling labelling, const Scene& scene,
                                           const SurfaceWishes& wishes,
                                           const SurfaceOptions& options, Log& log);

} // namespace vcarve
