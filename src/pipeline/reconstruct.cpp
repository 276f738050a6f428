#include "vcarve/reconstruct.h"

#include "base/freed_memory.h"
#include "base/validate.h"
#include "mesh/half_edge_mesh.h"
#include "model/scene_check.h"
#include "model/scene_size.h"
#include "pipeline/memory.h"
#include "pipeline/thinned_scene.h"
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

void foresee_memory(const RunSize& size, const Options& options, Log& log)
{
    Stage stage(log, "memory");
    const int threads = tbb::this_task_arena::max_concurrency();
    require_memory(size, threads, options.max_memory);
    const std::int64_t peak = predicted_peak(size, threads);
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
    FilteredPoints filtered = filter_points(std::move(scene), options, progress.part(0.0, 0.6));
    progress.tell(0.6);
    Scene sorted = spatial_sort(std::move(filtered.scene), progress.part(0.6, 1.0));
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
    const std::int64_t num_points = size_of(scene.num_points());
    CroppedPoints cropped = crop_points(std::move(scene), *region, stage);
    stage.end({{"points", cropped.inside},
               {"of", num_points},
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

/// From the points to the faces that views see; the cells are gone when it ends.
SeenSurface carve(const Scene& scene, const SurfaceWishes& wishes, const Options& options, Log& log)
{
    const TetMesh cells = triangulate(scene, log);
    return seen_surface(label_cells(cells, scene, options.labels, log), scene, wishes,
                        options.surface, log);
}

/// Checks which way the surface faces, and hands it over.
TriMesh orient(const HalfEdgeMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "orient");
    const ViewAgreement agreement = view_agreement(mesh, scene);
    TriMesh surface = tri_mesh(mesh);
    stage.end({{"sights on the outside", agreement.facing},
               {"of", agreement.sights},
               {"boundary edges", num_boundary_edges(mesh)}});
    return surface;
}

/// All steps but thinning. Faces that are taken away go to `removed`, where it is not null.
Reconstruction run_steps(Scene scene, const RunSize& size, const Options& options, Log& log,
                         RemovedFaces* removed = nullptr)
{
    scene = center_points(std::move(scene));
    return_freed_memory();
    foresee_memory(size, options, log);
    scene = filter(std::move(scene), options.points, log);
    const std::unique_ptr<Region> region = make_region(options.crop.region, scene);
    scene = crop(std::move(scene), region.get(), log);
    denoise(scene, options.denoise, log);
    return_freed_memory();
    SeenSurface seen = carve(scene, {region.get(), removed}, options, log);
    return_freed_memory();
    const std::unique_ptr<HalfEdgeMesh> mesh =
        mended_surface(std::move(seen), removed, options.surface, log);
    refine(*mesh, scene, options.refine, log);
    TriMesh surface = orient(*mesh, scene, log);
    return {std::move(scene), std::move(surface)};
}

Reconstruction thin_and_run_steps(Scene scene, const Options& options, Log& log)
{
    RunSize size = size_before_thinning(size_of(scene), options.thin);
    size.in_parts = false;
    require_memory(size, tbb::this_task_arena::max_concurrency(), options.max_memory);
    scene = thin(std::move(scene), options.thin, log);
    size.thinned = size_of(scene);
    return run_steps(std::move(scene), size, options, log);
}

/// Calls run() with as many threads as the options say.
template <typename Run>
Reconstruction with_threads(const Options& options, const Run& run)
{
    validate(options);
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute(run);
}

} // namespace

Gather thin_while_reading(const ThinOptions& options)
{
    if (options.merge_px == 0.0) return {};
    return [options](SceneParts& parts, const Progress& progress) {
        return thin_points(parts, options, progress);
    };
}

Reconstruction reconstruct_thinned(Scene thinned, const SceneSize& read, const Options& options,
                                   Log& log, RemovedFaces* removed)
{
    return with_threads(options, [&] {
        RunSize size = size_before_thinning(read, options.thin);
        size.thinned = size_of(thinned);
        return run_steps(std::move(thinned), size, options, log, removed);
    });
}

Reconstruction reconstruct(Scene input, const Options& options, Log& log)
{
    validate(options);
    require_consistent(input);
    return with_threads(options,
                        [&] { return thin_and_run_steps(std::move(input), options, log); });
}

Reconstruction reconstruct(const std::filesystem::path& input, const PointsOptions& points,
                           const Options& options, Log& log)
{
    return with_threads(options, [&] {
        const auto check = [&](const SceneSize& read) {
            require_memory(size_before_thinning(read, options.thin),
                           tbb::this_task_arena::max_concurrency(), options.max_memory);
        };
        ReadModel model =
            read_found_model(input, points, log, {check, thin_while_reading(options.thin)});
        return reconstruct_thinned(std::move(model.scene), model.read, options, log);
    });
}

} // namespace vcarve
