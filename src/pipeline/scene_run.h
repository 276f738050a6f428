#pragma once

#include "io/images/find_photographs.h"
#include "io/input/read_model.h"
#include "model/scene_check.h"
#include "pipeline/stage_memory.h"
#include "steps/6_surface/carve_surface.h"
#include "stereo/dense_points.h"
#include "stereo/depth_picture.h"
#include "vcarve/options.h"
#include "vcarve/reconstruct.h"

#include <functional>

namespace vcarve {

/// Returns a function that merges the points of a cloud while they are read, as reconstruct() does
/// in memory. Empty if merging is disabled.
Gather thin_while_reading(const ThinOptions& options);

/// What a run needs besides points.
struct SceneRun {
    const Options& options; ///< without kAutoClosing
    const RunImages& images;
    Log& log;
    KeepDepthMap keep_depth = {}; ///< empty keeps depth maps in memory
    std::function<void(const Scene& fused)> take_fused =
        {};                    ///< receives dense points; may be empty
    bool wants_report = false; ///< records data of --report
};

/// The size of a run: before points are merged, a dense scene counts as empty.
RunSize size_of_run(const SceneSize& read, const SceneRun& run);

/// Points for reconstruct_thinned(), and the depth map with the most measured pixels.
struct MeasuredPoints {
    Scene scene;    ///< merged
    SceneSize read; ///< size before merging
    DepthPicture depth;
};

/// Measures dense points in the photographs, starting from the surface of the sparse points. Throws
/// InputError if fewer than 3 photographs are usable or the memory is insufficient.
MeasuredPoints measure_dense_points(Scene sparse, const SceneRun& run);

/// A reconstruction with the data of --report.
struct ReportedRun : Reconstruction {
    RemovedFaces removed;
    DepthPicture depth; ///< empty without dense points
};

/// Reconstructs a scene. The points of a cloud must have been merged by thin_while_reading().
/// `read` is the size of the input.
ReportedRun reconstruct_thinned(Scene thinned, const SceneSize& read, const SceneRun& run);

/// Refines a mesh with the photographs of the run, and colors its vertices. Throws InputError if
/// fewer than 3 photographs are usable.
TriMesh refined_mesh(const Scene& model, TriMesh mesh, const SceneRun& run);

/// Textures a mesh with the photographs of the run.
TexturedMesh texture_mesh(const Scene& model, TriMesh mesh, const SceneRun& run);

/// The options with the value that kAutoClosing means.
Options resolved(Options options);

} // namespace vcarve
