#include "base/stage_counts.h"
#include "base/statistics.h"
#include "base/text.h"
#include "mesh/collapse_edges.h"
#include "model/scene_check.h"
#include "pipeline/memory.h"
#include "pipeline/run_state.h"
#include "pipeline/stages.h"
#include "steps/1_points/arrange.h"
#include "steps/1_points/crop.h"
#include "steps/1_points/denoise.h"
#include "steps/1_points/filter.h"
#include "steps/1_points/stray_points.h"
#include "steps/1_points/thin.h"
#include "steps/2_planes/added_points.h"
#include "steps/3_cells/limits.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/4_visibility/inferred_rays.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/virtual_views.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/cleanup.h"
#include "steps/6_surface/provenance.h"
#include "steps/7_refine/refine.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace vcarve::stage_runs {

namespace {

std::int64_t thousandths(double px)
{
    return std::llround(1000.0 * px);
}

Counts cut_by(VisibilityEnergy energy, RunState& run, const Progress& progress)
{
    CutCells made =
        cut_cells(run.cells, run.points.scene, std::move(energy), run.options().labels, progress);
    run.labels = std::move(made.labels);
    return {{counts::kCells.inside, made.inside, size_of(run.cells.cells.size())},
            {counts::kCells.on_hull, made.on_hull}};
}

/// Adds the votes of rays to the energy.
void cast(const RaySource& source, RunState& run, const Progress& progress)
{
    const Scene& scene = run.points.scene;
    const Scales scales = measure_scales(run.cells, scene, &run.usual);
    RayCaster(run.cells, scene, scales, run.options().labels.trace)
        .cast(source, run.evidence.energy, progress);
}

/// Adds the votes of inferred rays, which a cloud's file lacks. Returns their number.
std::int64_t walk_inferred(RunState& run, double weight, const Progress& progress)
{
    const Scene& scene = run.points.scene;
    const Tracks inferred = inferred_rays(scene, progress.part(0.0, 0.5));
    RaySource source = photographs(scene);
    source.rays = &inferred;
    source.weight = weight;
    source.is_measured = false;
    cast(source, run, progress.part(0.5, 1.0));
    return size_of(inferred.views.size());
}

/// A sentence that names the filter that dropped most points; empty if none dropped any.
std::string largest_loss(const FilterReport& dropped, std::int64_t stray, std::int64_t all,
                         const FilterOptions& options)
{
    const std::pair<std::int64_t, std::string> losses[] = {
        {dropped.few_views, fmt::format("--min-views {}; try {}--rays nearest", options.min_views,
                                        options.min_views > 1 ? "a smaller value, or " : "")},
        {dropped.high_error,
         fmt::format("--max-error {}; try a larger value", options.max_error_px)},
        {dropped.low_angle,
         fmt::format("--min-angle {}; try a smaller value", options.min_angle_deg)},
        {stray, fmt::format("--stray-spacing {}; try a larger value", options.stray_spacing)},
        {dropped.duplicate, "the merging of duplicate points"},
        {dropped.non_finite, "the check for finite coordinates"}};
    const auto& [count, filter] = *std::ranges::max_element(losses);
    return count == 0 ? ""
                      : fmt::format(". {} of {} were dropped by {}", grouped_digits(count),
                                    counted(all, "points"), filter);
}

} // namespace

Counts predict_memory(RunState& run, const Progress& /*progress*/)
{
    const int threads = tbb::this_task_arena::max_concurrency();
    require_memory(run.size, threads, run.options().memory.limit);
    return {{counts::kPlan.memory, (predicted_peak(run.size, threads) >> 20) + 1}};
}

Counts thin(RunState& run, const Progress& progress)
{
    Scene& scene = run.points.scene;
    const std::int64_t before = size_of(scene.num_points());
    scene = thin_points(scene, run.options().thin, progress);
    return {{counts::kMerge.points, size_of(scene.num_points()), before}};
}

Counts filter(RunState& run, const Progress& progress)
{
    Scene& scene = run.points.scene;
    const FilterOptions& options = run.options().points;
    const std::int64_t before = size_of(scene.num_points());
    FilteredPoints filtered = filter_points(std::move(scene), options, progress.part(0.0, 0.6));
    progress.report(0.6);
    scene = spatial_sort(std::move(filtered.scene), progress.part(0.6, 0.9));
    const std::int64_t stray = drop_stray_points(scene, options, &run.usual);
    const FilterReport& dropped = filtered.report;
    if (dropped.non_finite > 0) {
        run.notes.push_back(fmt::format("{} of {} are dropped: a coordinate is not finite, or "
                                        "beyond {:.0e}",
                                        grouped_digits(dropped.non_finite),
                                        counted(before, "points"), kFarthest));
    }
    require_four_points(scene.num_points(), largest_loss(dropped, stray, before, options));
    constexpr double kSmallDeg = 3.0; // COLMAP's mapper keeps points from 1.5 degrees on
    const double angle_deg = median_angle_deg(scene);
    if (angle_deg > 0.0 && angle_deg < kSmallDeg) {
        run.notes.push_back(fmt::format(
            "the rays of half of the points meet at less than {:.1f} degrees, so depths are "
            "uncertain and the surface may have spikes; take photographs from positions farther "
            "apart, or try a larger --min-angle",
            angle_deg));
    }
    return {{counts::kFilter.points, size_of(scene.num_points()), before},
            {counts::kFilter.duplicate, dropped.duplicate},
            {counts::kFilter.few_views, dropped.few_views},
            {counts::kFilter.high_error, dropped.high_error},
            {counts::kFilter.low_angle, dropped.low_angle},
            {counts::kFilter.stray, stray},
            {counts::kFilter.non_finite, dropped.non_finite}};
}

Counts add_points(RunState& run, const Progress& progress)
{
    const AddedPoints report =
        vcarve::add_points(run.points.scene, run.options().added_points, progress, &run.usual);
    return {{counts::kPoints.added, report.added}, {counts::kPoints.regions, report.regions}};
}

/// Crops to the region; Kind::looked_at is measured before points are dropped.
Counts crop(RunState& run, const Progress& progress)
{
    auto& [scene, of_interest] = run.points;
    const RegionChoice& choice = run.options().crop.region;
    const std::int64_t before = size_of(scene.num_points());
    if (choice.kind == RegionChoice::Kind::looked_at) of_interest = region_of_interest(scene);
    run.region = make_region(choice, scene.offset, of_interest);
    CroppedPoints cropped = crop_points(std::move(scene), *run.region, progress);
    scene = std::move(cropped.scene);
    return {{counts::kPoints.inside, cropped.inside, before},
            {counts::kPoints.witnesses, cropped.witnesses}};
}

Counts denoise(RunState& run, const Progress& progress)
{
    Scene& scene = run.points.scene;
    const DenoiseReport report = denoise_points(scene, run.options().denoise, progress, &run.usual);
    return {{counts::kDenoise.points, report.moved, size_of(scene.num_points())},
            {counts::kDenoise.noise, thousandths(report.noise_px)}};
}

Counts triangulate(RunState& run, const Progress& progress)
{
    const Scene& scene = run.points.scene;
    const int threads = tbb::this_task_arena::max_concurrency();
    run.cells = vcarve::triangulate(scene, progress, most_cells(run.size, threads));
    return {{counts::kCells.all, size_of(run.cells.cells.size())}};
}

Counts walk_rays(RunState& run, const Progress& progress)
{
    const Scene& scene = run.points.scene;
    std::int64_t inferred = 0;
    if (run.options().labels.method == Method::strict) {
        CrossingCounter(run.cells).cast(photographs(scene), run.evidence.crossings, progress);
    } else {
        const double weight = run.options().labels.trace.inferred_rays;
        const bool infers = scene.is_dense && weight > 0.0;
        cast(photographs(scene), run, progress.part(0.0, infers ? 0.5 : 1.0));
        if (infers) inferred = walk_inferred(run, weight, progress.part(0.5, 1.0));
    }
    return {{counts::kCells.rays, size_of(scene.num_rays())}, {counts::kCells.inferred, inferred}};
}

Counts place_virtual_views(RunState& run, const Progress& progress)
{
    VirtualRays& rays = run.virtual_rays;
    rays = find_virtual_rays(run.cells, run.points.scene, run.labels,
                             run.options().labels.virtual_views, progress);
    return {{counts::kViewpoints.views, size_of(rays.centers.size())},
            {counts::kViewpoints.rays, size_of(rays.tracks.views.size())}};
}

Counts walk_virtual_rays(RunState& run, const Progress& progress)
{
    const LabelOptions& options = run.options().labels;
    const VirtualRays& rays = run.virtual_rays;
    const RaySource source = rays.source(options.virtual_views.weight);
    if (options.method == Method::strict) {
        CrossingCounter(run.cells).cast(source, run.evidence.crossings, progress);
    } else {
        cast(source, run, progress);
    }
    return {{counts::kCells.rays, size_of(rays.tracks.views.size())}};
}

Counts cut_first(RunState& run, const Progress& progress)
{
    return cut_by(run.evidence.energy, run, progress);
}

Counts cut(RunState& run, const Progress& progress)
{
    return cut_by(std::exchange(run.evidence.energy, {}), run, progress);
}

Counts carve_first(RunState& run, const Progress& /*progress*/)
{
    const int min_crossings = run.options().labels.min_crossings;
    run.labels = vcarve::carve(run.cells, run.evidence.crossings, min_crossings);
    return {{counts::kCells.inside, std::ranges::count(run.labels, Label::inside),
             size_of(run.cells.cells.size())}};
}

Counts carve(RunState& run, const Progress& progress)
{
    Counts counts = carve_first(run, progress);
    run.evidence.crossings = {};
    return counts;
}

Counts surface(RunState& run, const Progress& progress)
{
    run.carved = carve_surface(std::move(run.labels),
                               {run.cells, run.points.scene, run.region.get(), run.wants_removed,
                                &run.usual, !run.size.is_tile},
                               run.options().surface, progress);
    const CarvedCounts& left_out = run.carved.counts;
    Counts counts = {{counts::kSurface.faces, size_of(run.carved.faces.faces.size())},
                     {counts::kSurface.unseen, left_out.unseen},
                     {counts::kSurface.unsupported, left_out.closing},
                     {counts::kSurface.trimmed, left_out.trimmed}};
    if (run.region) counts.push_back({counts::kSurface.outside, left_out.out_of_region});
    return counts;
}

Counts clean(RunState& run, const Progress& /*progress*/)
{
    CleanSurface cleaned =
        clean_surface(std::move(run.carved.faces), run.options().surface.cleanup);
    run.mesh = std::move(cleaned.mesh);
    run.first_filled = cleaned.first_filled;
    Removals(run.wants_removed ? &run.carved.removed : nullptr)
        .add_deleted(*run.mesh, run.first_filled);
    const CleanupCounts& counts = cleaned.counts;
    return {{counts::kMesh.vertices, counts.vertices},
            {counts::kMesh.faces, counts.faces},
            {counts::kMesh.split_edges, counts.split_edges},
            {counts::kMesh.split_vertices, counts.split_vertices},
            {counts::kMesh.holes, counts.filled_holes},
            {counts::kMesh.components, counts.removed_components}};
}

/// Counts rays through open boundaries; filled holes are not open.
Counts count_open(RunState& run, const Progress& /*progress*/)
{
    const auto& [rays, past, open] = run.carved.openness.value();
    std::vector<std::array<Eigen::Vector3d, 3>> filled;
    for (std::size_t i = run.first_filled; i < run.mesh->n_faces(); ++i) {
        filled.push_back(run.mesh->triangle(handle_at<OpenMesh::FaceHandle>(i)));
    }
    return {{counts::kMesh.open, count_free(open, filled), rays}, {counts::kMesh.past, past}};
}

Counts denoise_vertices(RunState& run, const Progress& progress)
{
    const DenoiseVerticesCounts counts =
        denoise_vertices(*run.mesh, run.points.scene, run.options().denoise, progress, &run.usual);
    return {{counts::kDenoise.vertices, counts.moved, counts.vertices},
            {counts::kDenoise.held, counts.held},
            {counts::kDenoise.noise, thousandths(counts.noise_px)}};
}

/// Collapses edges, and then splits non-manifold edges and vertices as clean() does.
Counts decimate(RunState& run, const Progress& /*progress*/)
{
    constexpr double kMostMoved = 0.25; // in vertex spacings; an estimate, see collapse_edges()
    constexpr double kSmall = 4.0;      // squared spacings per face of min_component
    const double spacing = usual_value(&run.usual, &UsualValues::vertex_spacing, [&] {
        std::vector<double> spacings = vertex_spacings(*run.mesh);
        std::erase(spacings, 0.0);
        return median_in_place(spacings);
    });
    const double small = kSmall * spacing * spacing * run.options().surface.cleanup.min_component;
    TriMesh mesh = tri_mesh(*run.mesh);
    const std::int64_t before = size_of(mesh.faces.size());
    std::int64_t dropped = drop_small_components(mesh, small);
    mesh = collapse_edges(mesh, {.max_distance = kMostMoved * spacing});
    constexpr CleanupOptions kOnlySplit = {.min_component = 0, .max_hole = 0};
    mesh = tri_mesh(*clean_surface(std::move(mesh), kOnlySplit).mesh);
    dropped += drop_small_components(mesh, small);
    CleanSurface cleaned = clean_surface(std::move(mesh), kOnlySplit);
    run.mesh = std::move(cleaned.mesh);
    return {{counts::kMerge.faces, cleaned.counts.faces, before},
            {counts::kMerge.components, dropped}};
}

Counts guard_rays(RunState& run, const Progress& progress)
{
    run.guard.emplace(run.points.scene, *run.mesh, progress);
    return {{counts::kSmooth.rays, run.guard->num_rays()}};
}

Counts smooth(RunState& run, const Progress& progress)
{
    const SmoothCounts counts =
        smooth_surface(*run.mesh, *run.guard, run.options().refine.smooth, progress);
    return {{counts::kSmooth.moved, counts.moved, counts.vertices},
            {counts::kSmooth.held, counts.held}};
}

Counts simplify(RunState& run, const Progress& progress)
{
    const SimplifyOptions& options = run.options().refine.simplify;
    const SimplifyCounts counts = simplify_surface(*run.mesh, *run.guard, options, progress);
    if (counts.faces > options.faces) {
        run.notes.push_back(fmt::format("stopped at {} instead of {}: more collapses would "
                                        "occlude observed points, or fold or tear the surface",
                                        counted(counts.faces, "faces"),
                                        grouped_digits(options.faces)));
    }
    return {{counts::kMerge.faces, counts.faces, counts.faces_before}};
}

Counts orient(RunState& run, const Progress& /*progress*/)
{
    const ViewAgreement agreement = view_agreement(*run.mesh, run.points.scene);
    run.surface = tri_mesh(*run.mesh);
    return {{counts::kMesh.outside, agreement.facing, agreement.rays},
            {counts::kMesh.boundary_edges, num_boundary_edges(*run.mesh)}};
}

} // namespace vcarve::stage_runs
