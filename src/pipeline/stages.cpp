#include "pipeline/stages.h"

#include <algorithm>
#include <cmath>

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

bool changes_mesh(const Needs& n)
{
    return smooths(n) || simplifies(n);
}

/// CPU seconds of one thing, and the share of them that is spread over threads. Measured on one
/// thread on models of 20 thousand to 1 million points, shares on clouds of 5 million on two.
struct Cost {
    double seconds;
    double parallel;
};

double seconds_of(const Needs& n, const Cost& cost, double count)
{
    return cost.seconds * count * (1.0 - cost.parallel + cost.parallel / n.threads);
}

/// The time of a stage that takes so many nanoseconds a point, of which so many percent are spread
/// over threads.
template <int kNanoseconds, int kPercent>
double of_points(const Needs& n)
{
    return seconds_of(n, {1e-9 * kNanoseconds, 0.01 * kPercent}, n.left.points);
}

double read_seconds(const Needs& n)
{
    const Cost merged = {0.95e-6, 0.75};
    const Cost read = {0.1e-6, 0.0};
    return seconds_of(n, n.in_parts ? merged : read, n.read.points);
}

double triangulate_seconds(const Needs& n)
{
    constexpr double kParallel = 50'000.0; // from so many points on
    return seconds_of(n, {5e-6, n.left.points < kParallel ? 0.0 : 0.98}, n.left.points);
}

/// A sight crosses more cells where these are smaller; those of a dense cloud go on in bundles.
double walk_seconds(const Needs& n)
{
    if (n.is_dense) return seconds_of(n, {0.8e-6, 0.99}, n.read.sights);
    const double cells_on_sight = std::pow(std::max(n.left.points, 1.0) / 1e6, 0.1);
    return seconds_of(n, {1.3e-6, 0.99}, n.read.sights * cells_on_sight);
}

double virtual_seconds(const Needs& n)
{
    return walk_seconds(n) + seconds_of(n, {4e-3, 0.95}, n.options.labels.virtual_views.count);
}

double virtual_walk_seconds(const Needs& n)
{
    return seconds_of(n, {0.4e-3, 0.95}, n.options.labels.virtual_views.count);
}

double surface_seconds(const Needs& n)
{
    constexpr double kMostViews = 1024; // of a scanner that moves, about as many places count
    double seconds = seconds_of(n, {0.5e-6, 0.7}, n.left.points);
    if (n.options.surface.closed) return seconds;
    // Views look at faces that may be sheets.
    seconds += seconds_of(n, {0.7e-3, 0.9}, std::min(n.read.views, kMostViews));
    // More of a strict surface is seen by no sight of its own.
    if (is_strict(n)) seconds += seconds_of(n, {45e-6, 0.9}, n.left.points);
    return seconds;
}

double open_seconds(const Needs& n)
{
    return seconds_of(n, {40e-3, 0.9}, 1.0);
}

double guard_seconds(const Needs& n)
{
    return seconds_of(n, {13e-6, 0.95}, n.read.sights);
}

double smooth_seconds(const Needs& n)
{
    return seconds_of(n, {150e-6, 0.95}, n.options.refine.smooth.iterations * n.left.points);
}

double simplify_seconds(const Needs& n)
{
    constexpr double kFacesPerPoint = 1.8;
    const double faces = kFacesPerPoint * n.left.points;
    return seconds_of(n, {0.5e-3, 0.0}, std::max(faces - n.options.refine.simplify.faces, 0.0));
}

using enum Part;
namespace run = stage_runs;

constexpr RunStage kStages[] = {
    {"read", input, always, nullptr, reading, read_seconds},
    {"thin", input, merges_in_memory, run::thin, thinning},
    {"memory", plan, always, run::foresee_memory},
    {"filter", points, always, run::filter, filtering, of_points<650, 80>},
    {"fill", points, adds_to_model, run::add_points, finding_planes, of_points<7000, 84>},
    {"crop", points, is_cropped, run::crop, nullptr, of_points<300, 80>},
    {"denoise", points, denoises_points, run::denoise, denoising, of_points<1900, 95>},
    {"fill", points, adds_to_cloud, run::add_points, finding_planes, of_points<7000, 84>},
    {"triangulate", cells, always, run::triangulate, triangulating, triangulate_seconds},
    {"sights", sights, always, run::walk_sights, tracing, walk_seconds},
    // Virtual views are placed by what the sights say, and say more.
    {"cut", sights, cuts_twice, run::cut_first, cutting, of_points<2200, 94>},
    {"carve", sights, carves_twice, run::carve_first, carving, of_points<70, 90>},
    {"virtual", sights, has_virtual_views, run::place_virtual_views, nullptr, virtual_seconds},
    {"sights", sights, has_virtual_views, run::walk_virtual_sights, tracing, virtual_walk_seconds},
    {"cut", surface, is_cut, run::cut, cutting, of_points<2200, 94>},
    {"carve", surface, is_strict, run::carve, carving, of_points<70, 90>},
    {"surface", surface, always, run::surface, extracting, surface_seconds},
    {"clean", refinement, always, run::clean, cleaning, of_points<470, 60>},
    {"open", refinement, may_be_open, run::count_open, nullptr, open_seconds},
    {"settle", refinement, denoises_vertices, run::settle, settling, of_points<2800, 70>},
    {"guard", refinement, changes_mesh, run::guard_sights, nullptr, guard_seconds},
    {"smooth", refinement, smooths, run::smooth, nullptr, smooth_seconds},
    {"simplify", refinement, simplifies, run::simplify, nullptr, simplify_seconds},
    {"orient", refinement, always, run::orient, nullptr, of_points<190, 60>},
    {"write", output, always, nullptr, nullptr, of_points<100, 50>},
};

} // namespace

std::span<const RunStage> all_stages()
{
    return kStages;
}

} // namespace vcarve
