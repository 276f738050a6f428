#pragma once

#include "mesh/half_edge_mesh.h"
#include "model/extent.h"
#include "model/tet_mesh.h"
#include "model/visibility_energy.h"
#include "pipeline/stage_memory.h"
#include "region/region.h"
#include "run/checkpoints.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/7_refine/sight_guard.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vcarve {

/// The points that are carved with.
struct CarvingPoints {
    Scene scene;
    Ball of_interest; ///< of all points, where only those in that ball are wanted
};

/// What the sights say of the cells.
struct SightEvidence {
    VisibilityEnergy energy; ///< empty with Method::strict
    Crossings crossings;     ///< empty with the others
};

/// What a run has, as its stages hand it on to each other (stages.h).
struct RunState {
    RunSize size;
    Checkpoints& checkpoints;
    bool wants_removed = false;

    CarvingPoints points{};
    std::unique_ptr<Region> region{}; ///< that the surface is wanted of; null for all of space
    TetMesh cells{};
    SightEvidence evidence{};
    Labels labels{};
    VirtualSights virtual_sights{};
    CarvedSurface carved{};
    std::unique_ptr<HalfEdgeMesh> mesh{};
    std::size_t first_filled = 0; ///< faces of the mesh from here on fill holes
    std::optional<SightGuard> guard{};
    TriMesh surface{};
    std::vector<std::string> notes{}; ///< told when the stage ends

    const Options& options() const { return size.options; }
};

template <>
inline constexpr int kNumFields<Ball> = 2;
template <>
inline constexpr int kNumFields<CarvingPoints> = 2;
template <>
inline constexpr int kNumFields<SightEvidence> = 2;
template <>
inline constexpr int kNumFields<ViewLine> = 2;
template <>
inline constexpr int kNumFields<Openness> = 3;
template <>
inline constexpr int kNumFields<RemovedFaces> = 2;
template <>
inline constexpr int kNumFields<CarvedSurface> = 4;

} // namespace vcarve
