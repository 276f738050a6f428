#include "pipeline/stages.h"

#include "io/images/find_photographs.h"
#include "pipeline/run_state.h"

#include <tbb/task_arena.h>

#include <string>
#include <utility>

namespace vcarve {

namespace {

bool always(const Needs&)
{
    return true;
}

bool is_strict(const Needs& n)
{
    return n.options.labels.method == Method::strict;
}

bool is_cut(const Needs& n)
{
    return !is_strict(n);
}

bool has_virtual_views(const Needs& n)
{
    return n.options.labels.virtual_views.count > 0;
}

bool cuts_twice(const Needs& n)
{
    return is_cut(n) && has_virtual_views(n);
}

bool carves_twice(const Needs& n)
{
    return is_strict(n) && has_virtual_views(n);
}

bool merges_in_memory(const Needs& n)
{
    return n.is_dense && n.options.thin.merge_px > 0.0 && !n.in_parts;
}

/// Method::strict, the paper's, uses only the given points.
bool adds_points(const Needs& n)
{
    return n.options.added_points.add_any() && is_cut(n);
}

/// A model gets added points before it is cropped, to use all points on its planes. A cloud gets
/// them after it is denoised.
bool adds_to_model(const Needs& n)
{
    return adds_points(n) && !n.is_dense;
}

bool adds_to_cloud(const Needs& n)
{
    return adds_points(n) && n.is_dense;
}

bool is_cropped(const Needs& n)
{
    return n.options.crop.region.kind != RegionChoice::Kind::everything;
}

bool denoises_points(const Needs& n)
{
    return n.is_dense && n.options.denoise.denoise > 0.0;
}

/// Dense clouds were denoised before, and Method::strict moves no points.
bool denoises_vertices(const Needs& n)
{
    return !n.is_dense && n.options.denoise.denoise > 0.0 && is_cut(n);
}

/// Holes are not counted with a region, because its boundary is no hole.
bool may_be_open(const Needs& n)
{
    return !n.options.surface.closed && !is_cropped(n) && !n.is_tile;
}

bool smooths(const Needs& n)
{
    return n.options.refine.smooth.iterations > 0;
}

bool simplifies(const Needs& n)
{
    return n.options.refine.simplify.faces > 0;
}

/// The default for surfaces of dense points, which have many more vertices than necessary.
bool decimates(const Needs& n)
{
    return n.is_dense && n.options.refine.simplify.faces == SimplifyOptions::kAutoFaces;
}

bool changes_mesh(const Needs& n)
{
    return smooths(n) || simplifies(n);
}

bool measures_dense(const Needs& n)
{
    return n.measures_dense;
}

/// Whether the surface that the run ends with is in memory as a whole.
bool ends_whole(const Needs& n)
{
    return !n.measures_dense && !n.is_tile;
}

bool has_masks(const Needs& n)
{
    return ends_whole(n) && !n.options.masks.folder.empty();
}

bool refines_by_photos(const Needs& n)
{
    return ends_whole(n) && n.options.dense.dense && n.options.dense.refine_px > 0;
}

bool merges_refined(const Needs& n)
{
    return refines_by_photos(n) && n.options.refine.simplify.faces != 0;
}

/// With photographs, vertices get their colors.
bool colors_mesh(const Needs& n)
{
    return ends_whole(n) && reads_photographs(n.options);
}

bool paints_texture(const Needs& n)
{
    return ends_whole(n) && n.options.texture.texture;
}

bool has_report(const Needs& n)
{
    return ends_whole(n) && n.has_report;
}

using enum Part;
namespace run = stage_runs;

constexpr RunStage kStages[] = {
    {"read", input, always, nullptr, reading},
    {"merge", input, merges_in_memory, run::thin, thinning},
    {"memory", plan, always, run::predict_memory},
    {"filter", points, always, run::filter, filtering},
    {"fill", points, adds_to_model, run::add_points, finding_planes},
    {"crop", points, is_cropped, run::crop},
    {"denoise", points, denoises_points, run::denoise, denoising},
    {"fill", points, adds_to_cloud, run::add_points, finding_planes},
    {"triangulate", cells, always, run::triangulate, triangulating},
    {"rays", rays, always, run::walk_rays, tracing},
    // Virtual viewpoints are placed in the cells of a first labeling, and add votes.
    {"cut", rays, cuts_twice, run::cut_first, cutting},
    {"carve", rays, carves_twice, run::carve_first, carving},
    {"viewpoints", rays, has_virtual_views, run::place_virtual_views},
    {"rays", rays, has_virtual_views, run::walk_virtual_rays, tracing},
    {"cut", surface, is_cut, run::cut, cutting},
    {"carve", surface, is_strict, run::carve, carving},
    {"surface", surface, always, run::surface, extracting},
    {"clean", refinement, always, run::clean, cleaning},
    {"open", refinement, may_be_open, run::count_open},
    {"adjust", refinement, denoises_vertices, run::denoise_vertices, adjusting},
    {"decimate", refinement, decimates, run::decimate},
    {"guard", refinement, changes_mesh, run::guard_rays},
    {"smooth", refinement, smooths, run::smooth},
    {"simplify", refinement, simplifies, run::simplify},
    {"orient", refinement, always, run::orient},
    // A run with dense points makes the sparse surface with the stages above. Then it measures
    // dense points, and makes their surface with the same stages, from "merge" on.
    {"undistort", dense, measures_dense, run::undistort, measuring_depth},
    {"depth", dense, measures_dense, run::match, measuring_depth},
    {"fuse", dense, measures_dense, run::fuse, measuring_depth},
    {"masks", masks, has_masks, run::remove_masked, masking},
    {"refine", photo_refinement, refines_by_photos, run::refine_by_photos, refining},
    {"decimate", photo_refinement, merges_refined, run::merge_refined, refining},
    {"photos", texture, colors_mesh, run::find_photos, finding_photos},
    {"colors", texture, colors_mesh, run::color, coloring},
    {"texture", texture, paints_texture, run::paint, painting},
    {"write", output, always, nullptr},
    {"report", output, has_report, nullptr, reporting},
};

} // namespace

std::span<const RunStage> all_stages()
{
    return kStages;
}

void run_stages(Part part, RunState& run)
{
    const Needs needs = needs_of(run.size, tbb::this_task_arena::max_concurrency());
    for (const RunStage& stage : all_stages()) {
        if (stage.part != part || stage.run == nullptr || !stage.applies(needs)) continue;
        Stage logged(run.log, stage.name);
        logged.end(stage.run(run, logged));
        for (const std::string& note : std::exchange(run.notes, {})) {
            run.log.note(note);
        }
    }
}

} // namespace vcarve
