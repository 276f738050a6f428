#include "pipeline.h"

#include "base/error.h"
#include "label/carve.h"
#include "label/sculpt.h"
#include "pipeline_memory.h"
#include "points/arrange.h"
#include "points/center.h"
#include "surface/extract.h"
#include "surface/orient.h"
#include "tetra/triangulate.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace vcarve {

namespace {

std::int64_t size_of(std::size_t count)
{
    return static_cast<std::int64_t>(count);
}

void foresee_memory(const Scene& scene, const Options& options, Log& log)
{
    Stage stage(log, "memory");
    const int threads = tbb::this_task_arena::max_concurrency();
    require_memory(size_of(scene), threads, options.max_memory);
    const std::int64_t peak = predicted_peak(size_of(scene), threads);
    stage.end({{"MiB expected", (peak >> 20) + 1}});
}

Scene filter(const Scene& scene, const Options& options, Log& log)
{
    Stage stage(log, "filter");
    FilteredPoints filtered = filter_points(scene, options.filter);
    Scene arranged = arrange_points(std::move(filtered.scene));
    const FilterReport& dropped = filtered.report;
    stage.end({{"points", size_of(arranged.num_points())},
               {"of", size_of(scene.num_points())},
               {"non-finite", dropped.non_finite},
               {"duplicate", dropped.duplicate},
               {"few views", dropped.few_views},
               {"high error", dropped.high_error},
               {"low angle", dropped.low_angle}});
    return arranged;
}

TetMesh triangulate(const Scene& scene, Log& log)
{
    Stage stage(log, "triangulate");
    TetMesh cells = triangulate(scene);
    stage.end({{"cells", size_of(cells.cells.size())}});
    return cells;
}

VirtualSights look_around(const TetMesh& cells, const Scene& scene, const Labels& labels,
                          const Options& options, Log& log)
{
    Stage stage(log, "virtual");
    VirtualSights sights = find_virtual_sights(cells, scene, labels, options.virtual_views, stage);
    stage.end({{"views", size_of(sights.centers.size())},
               {"sights", size_of(sights.tracks.views.size())}});
    return sights;
}

Labels carve(const TetMesh& cells, const Crossings& crossings, const Options& options, Log& log)
{
    Stage stage(log, "carve");
    Labels labels = carve(cells, crossings, options.min_crossings);
    stage.end({{"inside", std::count(labels.begin(), labels.end(), Label::inside)}});
    return labels;
}

Labels carve(const TetMesh& cells, const Scene& scene, const Options& options, Log& log)
{
    Stage trace(log, "sights");
    Crossings crossings = count_crossings(cells, scene, trace);
    trace.end({{"sights", size_of(scene.num_sights())}});
    Labels labels = carve(cells, crossings, options, log);
    if (options.virtual_views.count == 0) {
        return labels;
    }
    const VirtualSights more = look_around(cells, scene, labels, options, log);
    Stage trace_more(log, "sights");
    add_crossings(cells, more, options.virtual_views.weight, crossings, trace_more);
    trace_more.end({{"sights", size_of(more.tracks.views.size())}});
    return carve(cells, crossings, options, log);
}

Labels cut(const TetMesh& cells, const Scene& scene, Votes votes, const Options& options, Log& log)
{
    Stage label(log, "cut");
    const std::int32_t one_sight = votes.unit;
    MinimumCut minimum = cut(cells, std::move(votes), options.cut);
    DoubtedLabels doubted = doubt_webs(cells, scene, minimum, one_sight, options.webs);
    Labels& labels = doubted.labels;
    const std::int64_t needles = take_back_needles(cells, scene, options.needles, labels);
    label.end({{"inside", std::count(labels.begin(), labels.end(), Label::inside)},
               {"webs doubted", doubted.doubts},
               {"cells taken back", doubted.taken_back},
               {"needles", needles}});
    return std::move(labels);
}

Labels cut(const TetMesh& cells, const Scene& scene, const Options& options, Log& log)
{
    Stage trace(log, "sights");
    Votes votes = trace_sights(cells, scene, options.trace, trace);
    trace.end({{"sights", size_of(scene.num_sights())}});
    if (options.virtual_views.count == 0) {
        return cut(cells, scene, std::move(votes), options, log);
    }
    const Labels first = cut(cells, scene, votes, options, log);
    const VirtualSights more = look_around(cells, scene, first, options, log);
    Stage trace_more(log, "sights");
    add_votes(cells, scene, more, options.virtual_views.weight, options.trace, votes, trace_more);
    trace_more.end({{"sights", size_of(more.tracks.views.size())}});
    return cut(cells, scene, std::move(votes), options, log);
}

Labels alpha_shape(const TetMesh& cells, const Options& options, Log& log)
{
    Stage stage(log, "alpha shape");
    Labels labels = alpha_shape(cells, options.alpha.alpha * smallest_whole_alpha(cells));
    const auto inside = std::count(labels.begin(), labels.end(), Label::inside);
    stage.end({{"inside", inside}});
    if (inside == 0) {
        throw InputError(fmt::format("no cell is as small as --alpha {} asks for: 1 is the "
                                     "smallest that keeps all points",
                                     options.alpha.alpha));
    }
    return labels;
}

Labels sculpt(const TetMesh& cells, Log& log)
{
    Stage stage(log, "sculpt");
    Labels labels = sculpt(cells);
    stage.end({{"inside", std::count(labels.begin(), labels.end(), Label::inside)}});
    return labels;
}

Labels label_cells(const TetMesh& cells, const Scene& scene, const Options& options, Log& log)
{
    switch (options.method) {
    case Method::strict:
        return carve(cells, scene, options, log);
    case Method::alpha:
        return alpha_shape(cells, options, log);
    case Method::sculpt:
        return sculpt(cells, log);
    case Method::cut:
        break;
    }
    return cut(cells, scene, options, log);
}

TriMesh extract(const TetMesh& cells, const Labels& labels, const Scene& scene,
                const Options& options, Log& log)
{
    Stage stage(log, "surface");
    const std::vector<CellFacet> facets = boundary_facets(cells, labels);
    TriMesh surface = extract_surface(cells, facets, scene);
    FaceFlags keep(facets.size(), 1);
    std::int64_t sheets = 0;
    if (!options.closed && !ignores_views(options.method)) {
        const FaceVisibility visibility(cells, labels, scene);
        keep = supported_faces(surface, facets, visibility, scene, options.support);
        sheets = peel_sheets(surface, facets, visibility, options.sheets, keep);
    }
    surface = with_faces(std::move(surface), keep);
    const std::int64_t dropped = size_of(facets.size() - surface.faces.size());
    stage.end({{"faces", size_of(surface.faces.size())},
               {"unseen", dropped - sheets},
               {"sheets", sheets}});
    if (surface.faces.empty()) {
        throw InputError("the sights leave no surface: no part of the space behind the points is "
                         "seen well enough");
    }
    return surface;
}

TriMesh clean(TriMesh mesh, const Options& options, Log& log)
{
    Stage stage(log, "clean");
    CleanSurface cleaned = clean_surface(std::move(mesh), options.cleanup);
    stage.end({{"vertices", size_of(cleaned.mesh.positions.size())},
               {"faces", size_of(cleaned.mesh.faces.size())},
               {"split edges", cleaned.counts.split_edges},
               {"split vertices", cleaned.counts.split_vertices},
               {"components dropped", cleaned.counts.removed_components},
               {"holes filled", cleaned.counts.filled_holes}});
    return std::move(cleaned.mesh);
}

SightGuard guard_sights(const TriMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "guard");
    SightGuard guard(scene, mesh);
    stage.end({{"free sights", guard.num_free()}, {"of", guard.num_sights()}});
    return guard;
}

TriMesh smooth(const TriMesh& mesh, const SightGuard& guard, const Options& options, Log& log)
{
    Stage stage(log, "smooth");
    SmoothedSurface smoothed = smooth_surface(mesh, guard, options.smooth);
    stage.end({{"vertices moved", smoothed.counts.moved},
               {"of", size_of(mesh.positions.size())},
               {"held by sights", smoothed.counts.held}});
    return std::move(smoothed.mesh);
}

TriMesh simplify(const TriMesh& mesh, const SightGuard& guard, const Options& options, Log& log)
{
    Stage stage(log, "simplify");
    TriMesh simple = simplify_surface(mesh, guard, options.simplify);
    stage.end({{"faces", size_of(simple.faces.size())}, {"of", size_of(mesh.faces.size())}});
    if (simple.faces.size() > static_cast<std::size_t>(options.simplify.faces)) {
        log.note(fmt::format("{} faces are left, not {}: merging more vertices would hide what was "
                             "seen, or fold or tear the surface",
                             simple.faces.size(), options.simplify.faces));
    }
    return simple;
}

/// Moves and merges vertices where that is asked for.
TriMesh refine(TriMesh mesh, const Scene& scene, const Options& options, Log& log)
{
    const bool smooths = options.smooth.iterations > 0;
    const bool simplifies = options.simplify.faces > 0;
    if (!smooths && !simplifies) return mesh;
    const SightGuard guard = guard_sights(mesh, scene, log);
    if (smooths) mesh = smooth(mesh, guard, options, log);
    if (simplifies) mesh = simplify(mesh, guard, options, log);
    return mesh;
}

void check_orientation(const TriMesh& mesh, const Scene& scene, Log& log)
{
    Stage stage(log, "orient");
    const ViewAgreement agreement = view_agreement(mesh, scene);
    stage.end({{"sights on the outside", agreement.facing}, {"of", agreement.sights}});
}

Reconstruction run_passes(Scene input, const Options& options, Log& log)
{
    foresee_memory(input, options, log);
    Scene scene = filter(center_points(std::move(input)), options, log);
    const TetMesh cells = triangulate(scene, log);
    const Labels labels = label_cells(cells, scene, options, log);
    TriMesh surface = extract(cells, labels, scene, options, log);
    TriMesh cleaned = clean(std::move(surface), options, log);
    TriMesh mesh = refine(std::move(cleaned), scene, options, log);
    check_orientation(mesh, scene, log);
    return {std::move(scene), std::move(mesh)};
}

} // namespace

Reconstruction reconstruct(Scene input, const Options& options, Log& log)
{
    tbb::task_arena arena(options.threads == 0 ? tbb::task_arena::automatic : options.threads);
    return arena.execute([&] { return run_passes(std::move(input), options, log); });
}

} // namespace vcarve
