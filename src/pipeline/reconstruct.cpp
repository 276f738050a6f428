#include "vcarve/reconstruct.h"

#include "base/freed_memory.h"
#include "base/validate.h"
#include "mesh/half_edge_mesh.h"
#include "model/scene_check.h"
#include "model/scene_size.h"
#include "pipeline/memory.h"
#include "steps/1_points/center.h"
#include "steps/1_points/crop.h"
#include "steps/1_points/denoise.h"
#include "steps/1_points/filter.h"
#include "steps/1_points/region.h"
#include "steps/1_points/spatial_sort.h"
#include "steps/1_points/thin.h"
#include "steps/2_cells/triangulate.h"
#include "steps/4_labels/label_cells.h"
#include "steps/5_surface/make_surface.h"
#include "steps/5_surface/orient.h"
#include "steps/6_refine/refine.h"

#include <tbb/task_arena.h>

#include <cmath>
#include <memory>
#include <utility>

namespace vcarve {

namespace {

void foresee_memory(const SceneSize& read, const SceneSize& thinned, const Options& options,
                    Log& log)
{
    Stage stage(log, "memory");
    const int threads = tbb::this_task_arena::max_concurrency();
    require_memory(read, thinned, threads, options.max_memory);
    const std::int64_t peak = predicted_peak(read, thinned, threads);
    stage.end({{"MiB expected", (peak >> 20) + 1}});
}

/// The scene itself where there is nothing to merge.
Scene thin(Scene scene, const ThinOptions& options, Log& log)
{
    if (options.merge_px == 0.0 || !has_dense_points(scene)) return scene;
    Stage stage(log, "thin");
    Scene thinned = thin_points(scene, options, stage);
    stage.end({{"points", size_of(thinned.num_points())}, {"of", size_of(scene.num_points())}});
    return thinned;
}

void denoise(Scene& scene, const DenoiseOptions& options, Log& log)
{
    if (options.denoise == 0.0 || !has_dense_points(scene)) return;
    Stage stage(log, "denoise");
    const DenoiseReport report = denoise_points(scene, options, stage);
    stage.end({{"points moved", report.moved},
               {"of", size_of(scene.num_points())},
               {"thousandths of a pixel of noise", std::llround(1000.0 * report.noise_px)}});
}

Scene filter(Scene scene, const FilterOptions& options, Log& log)
{
    Stage stage(log, "filter");
    const std::int64_t num_points = size_of(scene.num_points());
    const Progress progress(stage);
    FilteredPoints filtered = filter_points(scene, options, progress.part(0.0, 0.6));
    scene = Scene(); // two are enough at a time
    progress.tell(0.6);
    Scene sorted = spatial_sort(filtered.scene, progress.part(0.6, 1.0));
    const FilterReport& dropped = filtered.report;
    stage.end({{"points", size_of(sorted.num_points())},
               {"of", num_points},
               {"non-finite", dropped.non_finite},
               {"duplicate", dropped.duplicate},
               {"few views", dropped.few_views},
               {"high error", dropped.high_error},
               {"low angle", dropped.low_angle}});
    return sorted;
}

/// The scene itself where there is no region.
Scene crop(Scene scene, const Region* region, Log& log)
{
    if (region == nullptr) return scene;
    Stage stage(log, "crop");
    CroppedPoints cropped = crop_points(scene, *region, stage);
    stage.end({{"points", cropped.inside},
               {"of", size_of(scene.num_points())},
               {"outside but seen through it", cropped.witnesses}});
    return std::move(cropped.scene);
}

TetMesh triangulate(const Scene& scene, Log& log)
{
    Stage stage(log, "triangulate");
    TetMesh cells = triangulate(scene, stage);
    stage.end({{"cells", size_of(cells.cells.size())}});
    return cells;
}

/// Checks which way the surface faces, and hands it over.
TriMesh orient(const HalfEdgeMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "orient");
    const ViewAgreement agreement = view_agreement(mesh, scene);
    TriMesh surface = tri_mesh(mesh);
    stage.end({{"sights on the outside", agreement.facing}, {"of", agreement.sights}});
    return surface;
}

Reconstruction run_steps(Scene input, const Options& options, Log& log)
{
    const SceneSize read = size_of(input);
    require_memory(read, least_thinned(read), tbb::this_task_arena::max_concurrency(),
                   options.max_memory);
    Scene scene = thin(center_points(std::move(input)), options.thin, log);
    return_freed_memory();
    foresee_memory(read, size_of(scene), options, log);
    scene = filter(std::move(scene), options.points, log);
    const std::unique_ptr<Region> region = make_region(options.crop.region, scene);
    scene = crop(std::move(scene), region.get(), log);
    denoise(scene, options.denoise, log);
    return_freed_memory();
    const TetMesh cells = triangulate(scene, log);
    Labelling labelling = label_cells(cells, scene, options.labels, log);
    const std::unique_ptr<HalfEdgeMesh> mesh =
        make_surface(std::move(labelling), scene, region.get(), options.surface, log);
    refine(*mesh, scene, options.refine, log);
    TriMesh surface = orient(*mesh, scene, log);
    return {std::move(scene), std::move(surface)};
}

} // namespace

Reconstruction reconstruct(Scene input, const Options& options, Log& log)
{
    validate(options);
    require_consistent(input);
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute([&] { return run_steps(std::move(input), options, log); });
}

} // namespace vcarve
