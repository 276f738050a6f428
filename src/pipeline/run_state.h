#pragma once

#include "io/images/calibrated_photo.h"
#include "mesh/half_edge_mesh.h"
#include "model/extent.h"
#include "model/tet_mesh.h"
#include "model/usual_values.h"
#include "model/visibility_energy.h"
#include "pipeline/stage_memory.h"
#include "region/region.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/7_refine/ray_guard.h"
#include "stereo/dense_points.h"
#include "stereo/depth_picture.h"
#include "texture/texture_mesh.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The points of the triangulation.
struct CarvingPoints {
    Scene scene;
    Ball of_interest; ///< of the points before cropping; set only for RegionChoice::Kind::looked_at
};

/// The votes of the rays on the cells.
struct RayEvidence {
    VisibilityEnergy energy; ///< empty with Method::strict
    Crossings crossings;     ///< empty with other methods
};

/// The data that the stages of a run (stages.h) pass on.
struct RunState {
    RunSize size;
    Log& log;
    bool wants_removed = false;

    UsualValues usual{}; ///< measured by the stages, unless known before

    CarvingPoints points{};
    std::unique_ptr<Region> region{}; ///< region to reconstruct; null for all of space
    TetMesh cells{};
    RayEvidence evidence{};
    Labels labels{};
    VirtualRays virtual_rays{};
    CarvedSurface carved{};
    std::unique_ptr<HalfEdgeMesh> mesh{};
    std::size_t first_filled = 0; ///< faces of the mesh from here on fill holes
    std::optional<RayGuard> guard{};
    TriMesh surface{};

    const RunImages* images = nullptr;     ///< photographs and masks; null if the run reads none
    KeepDepthMap keep_depth{};             ///< keeps depth maps in files, if any
    std::vector<CalibratedPhoto> photos{}; ///< usable photographs, in the frame of the surface
    DenseStereo stereo{};
    Scene dense{}; ///< the points of Part::dense
    DepthPicture depth{};
    double refined_pixel = 0.0; ///< scene units per pixel of disparity, see RefinedCounts
    MeshPhotos shown{};
    Texture texture{};

    std::vector<std::string> notes{}; ///< logged when the stage ends

    const Options& options() const { return size.options; }
};

} // namespace vcarve
