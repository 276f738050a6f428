#pragma once

#include "base/progress.h"
#include "mesh/removed_faces.h"
#include "model/labels.h"
#include "model/tet_mesh.h"
#include "region/region.h"
#include "steps/6_surface/openness.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstdint>
#include <optional>

namespace vcarve {

/// What a surface is made of, beside labels of the cells.
struct SurfaceInput {
    const TetMesh& cells;
    const Scene& scene;
    const Region* region = nullptr;  ///< which part of space is wanted; null for all
    RemovedFaces* removed = nullptr; ///< gets the faces that are taken away; null where nobody asks
};

/// The faces that were chosen for a surface, before they are mended.
struct SeenSurface {
    TriMesh faces; ///< with TriMesh::points
    /// What they leave open; not known where all faces are kept, or a region leaves some out.
    std::optional<Openness> openness;
};

/// A surface, and how many faces of the boundary are not in it.
struct MadeSurface {
    SeenSurface seen{};
    std::int64_t unseen = 0;
    std::int64_t closing = 0; ///< without support
    std::int64_t trimmed = 0;
    std::int64_t out_of_region = 0;
};

/// Of the boundary of the labels (extract.h) the faces that views support (face_rules.h), or all
/// where the surface is to be closed, and of these, where there is a region, those whose corners
/// all lie within it. Throws InputError where no face is left.
MadeSurface make_surface(Labels labels, const SurfaceInput& input, const SurfaceOptions& options,
                         const Progress& progress);

} // namespace vcarve
