#include "pipeline/stages.h"

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

/// The paper's own method is of the points that are given.
bool adds_points(const Needs& n)
{
    return n.options.added_points.add_any() && is_cut(n);
}

/// Those of a model are added before it is cropped, by all that is known of its planes; those of a
/// cloud once its noise is gone.
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

/// Points of a dense cloud were moved before; with the paper's own method all stay.
bool denoises_vertices(const Needs& n)
{
    return !n.is_dense && n.options.denoise.denoise > 0.0 && is_cut(n);
}

/// What a region leaves out is not open.
bool may_be_open(const Needs& n)
{
    return !n.options.surface.closed && !is_cropped(n);
}

bool smooths(const Needs& n)
{
    return n.options.refine.smooth.iterations > 0;
}

bool simplifies(const Needs& n)
{
    return n.options.refine.simplify.faces > 0;
}

/// By default, surfaces of dense points, which have many more vertices than they need.
bool decimates(const Needs& n)
{
    return n.is_dense && n.options.refine.simplify.faces == SimplifyOptions::kAutoFaces;
}

bool changes_mesh(const Needs& n)
{
    return smooths(n) || simplifies(n);
}

using enum Part;
namespace run = stage_runs;

constexpr RunStage kStages[] = {
    {"read", input, always, nullptr, reading},
    {"thin", input, merges_in_memory, run::thin, thinning},
    {"memory", plan, always, run::foresee_memory},
    {"filter", points, always, run::filter, filtering},
    {"fill", points, adds_to_model, run::add_points, finding_planes},
    {"crop", points, is_cropped, run::crop},
    {"denoise", points, denoises_points, run::denoise, denoising},
    {"fill", points, adds_to_cloud, run::add_points, finding_planes},
    {"triangulate", cells, always, run::triangulate, triangulating},
    {"sights", sights, always, run::walk_sights, tracing},
    // Virtual views are placed by what the sights say, and say more.
    {"cut", sights, cuts_twice, run::cut_first, cutting},
    {"carve", sights, carves_twice, run::carve_first, carving},
    {"virtual", sights, has_virtual_views, run::place_virtual_views},
    {"sights", sights, has_virtual_views, run::walk_virtual_sights, tracing},
    {"cut", surface, is_cut, run::cut, cutting},
    {"carve", surface, is_strict, run::carve, carving},
    {"surface", surface, always, run::surface, extracting},
    {"clean", refinement, always, run::clean, cleaning},
    {"open", refinement, may_be_open, run::count_open},
    {"settle", refinement, denoises_vertices, run::settle, settling},
    {"decimate", refinement, decimates, run::decimate},
    {"guard", refinement, changes_mesh, run::guard_sights},
    {"smooth", refinement, smooths, run::smooth},
    {"simplify", refinement, simplifies, run::simplify},
    {"orient", refinement, always, run::orient},
    {"write", output, always, nullptr},
};

} // namespace

std::span<const RunStage> all_stages()
{
    return kStages;
}

} // namespace vcarve
