#include "vcarve/reconstruct.h"

#include "base/freed_memory.h"
#include "io/work/stage_keeper.h"
#include "mesh/half_edge_mesh.h"
#include "model/scene_check.h"
#include "model/scene_size.h"
#include "options/declared.h"
#include "pipeline/memory.h"
#include "pipeline/rank_shares.h"
#include "pipeline/thinned_scene.h"
#include "region/region.h"
#include "steps/1_points/center.h"
#include "steps/1_points/crop.h"
#include "steps/1_points/denoise.h"
#include "steps/1_points/filter.h"
#include "steps/1_points/spatial_sort.h"
#include "steps/1_points/stray_points.h"
#include "steps/1_points/thin.h"
#include "steps/2_planes/added_points.h"
#include "steps/3_cells/triangulate.h"
#include "steps/3_cells/triangulate_blocks.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/kept_surface.h"
#include "steps/6_surface/make_surface.h"
#include "steps/6_surface/orient.h"
#include "steps/7_refine/refine.h"
#include "steps/7_refine/settle.h"

#include <tbb/task_arena.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

/// Refuses what does not fit into memory where all of it is to be there.
void require_memory_of(const RunSize& size, const MemoryOptions& options)
{
    if (options.blocks > 0) return;
    require_memory(size, tbb::this_task_arena::max_concurrency(), options.most);
}

void foresee_memory(const RunSize& size, const Options& options, Log& log)
{
    Stage stage(log, "memory");
    const int threads = tbb::this_task_arena::max_concurrency();
    require_memory_of(size, options.memory);
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
    Scene sorted = spatial_sort(std::move(filtered.scene), progress.part(0.6, 0.9));
    const std::int64_t stray = drop_stray_points(sorted, options);
    const FilterReport& dropped = filtered.report;
    stage.end({{"points", size_of(sorted.num_points())},
               {"of", num_points},
               {"non-finite", dropped.non_finite},
               {"duplicate", dropped.duplicate},
               {"few views", dropped.few_views},
               {"high error", dropped.high_error},
               {"low angle", dropped.low_angle},
               {"stray", stray}});
    return sorted;
}

/// None where the paper's own method is wanted, which is of the points that are given.
void add_creases(Scene& scene, const Options& options, Log& log)
{
    if (!options.creases.add_any() || options.labels.method == Method::strict) return;
    if (has_dense_points(scene)) return;
    Stage stage(log, "creases");
    const AddedPoints report = add_points(scene, options.creases, stage);
    stage.end({{"points added", report.added}, {"planar regions", report.regions}});
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

/// The same cells as triangulate(), made in so many blocks, each of which is kept by itself.
TetMesh triangulate_in_blocks(const Scene& scene, std::size_t count, StageKeeper& work,
                              const Progress& progress)
{
    SharedBlocks shared(count, work);
    // With other ranks, all blocks but those that gave up are there then.
    const bool is_shared = work.share(kBlocksTask, BlocksTask{count}, kNeededForBlocks, [&] {
        triangulate_share(scene, shared.own(), {0, work.num_ranks()}, progress.part(0.0, 0.8));
    });
    const Blocks blocks = is_shared ? shared.all() : kept_blocks(count, work);
    std::optional<TetMesh> cells =
        triangulate_in_blocks(scene, blocks, progress.part(is_shared ? 0.8 : 0.0, 1.0));
    if (cells) return std::move(*cells);
    work.log().note("so many points lie on common spheres or planes, or next to them, that they "
                    "are triangulated at once, which takes more memory");
    return triangulate_at_once(scene, progress);
}

TetMesh triangulate(const Scene& scene, int num_blocks, StageKeeper& work)
{
    Stage stage(work.log(), "triangulate");
    const auto count = static_cast<std::size_t>(std::max(num_blocks, 0));
    TetMesh cells =
        count == 0 ? triangulate(scene, stage) : triangulate_in_blocks(scene, count, work, stage);
    stage.end({{"cells", size_of(cells.cells.size())}});
    return cells;
}

/// The points that are carved with, and the part of space that the surface is wanted of.
struct Carvers {
    Scene scene;
    std::unique_ptr<Region> region; ///< null for all of space
};

Carvers prepare(Scene scene, const Options& options, StageKeeper& work)
{
    const auto filtered = [&] {
        Scene points = filter(std::move(scene), options.points, work.log());
        add_creases(points, options, work.log());
        return points;
    };
    std::unique_ptr<Region> region;
    const bool is_cropped = options.crop.region.kind != RegionChoice::Kind::everything;
    if (is_cropped) { // the region is found among points that it drops
        scene = work.stage("filtered", filtered);
        region = make_region(options.crop.region, scene);
    }
    scene = work.stage("points", [&] {
        Scene points = is_cropped ? crop(std::move(scene), region.get(), work.log()) : filtered();
        denoise(points, options.denoise, work.log());
        return points;
    });
    return {std::move(scene), std::move(region)};
}

/// From the points to the faces that views see; the cells are gone when it ends.
CarvedSurface carve(const Carvers& carvers, bool wants_removed, const Options& options,
                    StageKeeper& work)
{
    const Scene& scene = carvers.scene;
    const TetMesh cells =
        work.stage("cells", [&] { return triangulate(scene, options.memory.blocks, work); });
    CarvedSurface carved;
    const SurfaceWishes wishes = {carvers.region.get(), wants_removed ? &carved.removed : nullptr};
    carved.seen = seen_surface(cells, label_cells(cells, scene, options.labels, work), scene,
                               wishes, options.surface, work.log());
    return carved;
}

/// Points of a dense cloud were moved before; with the paper's own method all stay.
void settle(HalfEdgeMesh& mesh, const Scene& scene, const Options& options, Log& log)
{
    if (options.denoise.denoise == 0.0 || options.labels.method == Method::strict) return;
    if (has_dense_points(scene)) return;
    Stage stage(log, "settle");
    const SettleCounts counts = settle_vertices(mesh, scene, options.denoise, stage);
    stage.end({{"vertices moved", counts.moved},
               {"of", counts.vertices},
               {"held back", counts.held},
               {"thousandths of a pixel of noise", std::llround(1000.0 * counts.noise_px)}});
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

/// All steps but thinning.
Reconstruction run_steps(Scene scene, const RunSize& size, const Options& options, Log& shown,
                         const RunExtras& extras = {})
{
    StageKeeper work(extras.work, shown, extras.ranks);
    Log& log = work.log();
    scene = center_points(std::move(scene));
    return_freed_memory();
    foresee_memory(size, options, log);
    Carvers carvers = prepare(std::move(scene), options, work);
    return_freed_memory();
    const bool wants_removed = extras.removed != nullptr;
    CarvedSurface carved = work.stage(wants_removed ? "surface-and-removed" : "surface",
                                      [&] { return carve(carvers, wants_removed, options, work); });
    if (wants_removed) *extras.removed = std::move(carved.removed);
    return_freed_memory();
    scene = std::move(carvers.scene);
    const std::unique_ptr<HalfEdgeMesh> mesh =
        mended_surface(std::move(carved.seen), extras.removed, options.surface, log);
    settle(*mesh, scene, options, log);
    refine(*mesh, scene, options.refine, log);
    TriMesh surface = orient(*mesh, scene, log);
    return {std::move(scene), std::move(surface)};
}

Reconstruction thin_and_run_steps(Scene scene, const Options& options, Log& log)
{
    RunSize size = size_before_thinning(size_of(scene), options.thin);
    size.in_parts = false;
    require_memory_of(size, options.memory);
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
                                   Log& log, const RunExtras& extras)
{
    return with_threads(options, [&] {
        RunSize size = size_before_thinning(read, options.thin);
        size.thinned = size_of(thinned);
        return run_steps(std::move(thinned), size, options, log, extras);
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
            require_memory_of(size_before_thinning(read, options.thin), options.memory);
        };
        ReadModel model =
            read_found_model(input, points, log, {check, thin_while_reading(options.thin)});
        return reconstruct_thinned(std::move(model.scene), model.read, options, log);
    });
}

} // namespace vcarve
