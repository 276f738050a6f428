#include "options/declared.h"

namespace vcarve {

namespace {

constexpr const char* kPoints = "Points";
constexpr const char* kSights = "Lines of sight";
constexpr const char* kSurface = "Surface";

OptionList filter_options(FilterOptions& points)
{
    return {
        {kPoints,
         {.name = "min-views",
          .unit = "views",
          .help = "Drop points seen by fewer views.",
          .min = 1},
         &points.min_views},
        {kPoints,
         {.name = "max-error",
          .unit = "px",
          .help = "Drop points whose mean reprojection error is larger; 0 keeps all."},
         &points.max_error_px},
        {kPoints,
         {.name = "min-angle",
          .unit = "deg",
          .help = "Drop points whose rays all meet at a smaller angle; 0 keeps all.",
          .max = 180.0,
          .tuning = true},
         &points.min_angle_deg},
        {kPoints,
         {.name = "stray-spacing",
          .unit = "times",
          .help = "Drop points of two views that stand this many times the usual spacing away "
                  "from others, as seen from their views, or two thirds of that where their "
                  "error is large and 1.75 times where it is small; 0 keeps all.",
          .tuning = true},
         &points.stray_spacing},
    };
}

OptionList added_point_options(AddedPointOptions& added)
{
    return {
        {kPoints,
         {.name = "crease-reach",
          .unit = "x spacing",
          .help = "Add points where two planar regions of the surface meet and both have points "
                  "no farther than so many times their spacing from there, as at the foot of a "
                  "wall, where images show no features; 0 adds none.",
          .max = 1000.0,
          .tuning = true},
         &added.crease_reach},
        {kPoints,
         {.name = "border-gap",
          .unit = "x spacing",
          .help = "Add points where a planar region of the surface ends and rays pass by no "
                  "farther than so many times the spacing of its points, as at the eaves of a "
                  "roof; 0 adds none.",
          .max = 100.0,
          .tuning = true},
         &added.border_gap},
        {kPoints,
         {.name = "textureless-step",
          .unit = "x spacing",
          .help = "Add points so many times their spacing apart amid a planar region of the "
                  "surface where views look at it but images show no features, as on a plain "
                  "floor; 0 adds none.",
          .max = 100.0,
          .tuning = true},
         &added.textureless_step},
    };
}

OptionList cloud_options(Options& options)
{
    return {
        {kPoints,
         {.name = "merge-px",
          .unit = "px",
          .help = "Merge points of a dense cloud that lie within so many pixels of the images "
                  "that show them largest; 0 merges none.",
          .max = 1000.0},
         &options.thin.merge_px},
        {kPoints,
         {.name = "crop",
          .help = "Make the surface of a region only: auto, the ball in which 94 % of the rays "
                  "end; a box x0,y0,z0,x1,y1,z1; a PLY file with a closed surface; or a text file "
                  "with the x and y of a corner of a polygon a line, for all z.",
          .words = {"none", "auto"}},
         &options.crop.region},
        {kPoints,
         {.name = "denoise",
          .unit = "sigma",
          .help = "Smooth what lies within so many standard deviations of the points' own error: "
                  "the points of a dense cloud, the vertices of a sparse model's surface; 0 "
                  "moves none.",
          .max = 100.0},
         &options.denoise.denoise},
    };
}

OptionList method_options(LabelOptions& options)
{
    return {
        {kSights,
         {.name = "method",
          .help = "cut: the labelling that contradicts the rays least. strict: every cell that a "
                  "ray crosses is outside (for points without noise).",
          .words = {"cut", "strict"},
          .tuning = true},
         value_of_enum(options.method)},
        {kSights,
         {.name = "min-crossings",
          .unit = "rays",
          .help = "With --method strict: how many rays must cross a facet to carve the cells "
                  "beside it.",
          .min = 1,
          .tuning = true},
         &options.min_crossings},
    };
}

OptionList weight_options(TraceOptions& trace)
{
    return {
        {kSights,
         {.name = "views-sigma",
          .unit = "views",
          .help = "A ray weighs 1 - exp(-n^2 / 2 s^2) for a point of n views, relative to the "
                  "median point; 0 gives every ray the same weight.",
          .max = 100.0,
          .tuning = true},
         &trace.views_sigma},
        {kSights,
         {.name = "error-sigma",
          .unit = "x median error",
          .help = "A ray weighs exp(-(e^2 - 1) / 2 s^2) of that for a point whose reprojection "
                  "error is e > 1 medians; 0 takes no account of errors.",
          .max = 1000.0,
          .tuning = true},
         &trace.error_sigma},
    };
}

OptionList depth_options(TraceOptions& trace)
{
    return {
        {kSights,
         {.name = "distance-sigma",
          .unit = "x short edge",
          .help = "Uncertainty of a point along its rays, as a multiple of the 25th percentile of "
                  "edge lengths; 0 trusts every point fully.",
          .max = 1000.0,
          .tuning = true},
         &trace.distance_sigma},
        {kSights,
         {.name = "sink-depth",
          .unit = "x distance sigma",
          .help = "How far behind a point its rays call the space inside; 0 means the cell that "
                  "begins at the point.",
          .max = 1000.0,
          .tuning = true},
         &trace.sink_depth},
        {kSights,
         {.name = "bundle-sights",
          .unit = "rays",
          .help = "How many near rays of a dense cloud's points go on as one where they are far "
                  "from their points; 1 walks each to its view.",
          .min = 1,
          .max = 64,
          .tuning = true},
         &trace.bundle_sights},
        {kSights,
         {.name = "inferred-sights",
          .unit = "weight",
          .help = "Of a dense cloud: how much a ray counts of a camera that likely saw a point, "
                  "though fused.ply.vis does not say so; 0 leaves them out.",
          .min = 0.0,
          .max = 10.0,
          .tuning = true},
         &trace.inferred_weight},
    };
}

OptionList cut_options(LabelOptions& options)
{
    return {
        {kSights,
         {.name = "quality",
          .unit = "rays",
          .help = "What a badly shaped facet costs in the cut, in rays of full weight; 0 lets "
                  "only the rays decide.",
          .max = 100'000.0,
          .tuning = true},
         &options.cut.quality},
        {kSights,
         {.name = "hull-edge",
          .unit = "x local edge",
          .help = "Let the surface go on along the hull of the points, where they are seen from "
                  "within only, by faces of edges up to this many times the median around; 0 lets "
                  "it end.",
          .tuning = true},
         &options.hull.hull_edge},
    };
}

OptionList virtual_view_options(VirtualViewOptions& views)
{
    return {
        {kSights,
         {.name = "virtual-views",
          .unit = "views",
          .help = "How many viewpoints to place in space that rays have shown to be free, to look "
                  "from there at the points around and label the cells again; 100 suit some "
                  "thousand points, 0 places none.",
          .max = 10'000,
          .tuning = true},
         &views.count},
        {kSights,
         {.name = "virtual-weight",
          .unit = "rays",
          .help = "What a ray of such a viewpoint counts, relative to a real one of the same "
                  "point.",
          .max = 100.0,
          .tuning = true},
         &views.weight},
    };
}

OptionList surface_options(SurfaceOptions& surface)
{
    return {
        {kSurface,
         {.name = "closed", .help = "Make it watertight: also keep faces that no view sees."},
         &surface.closed},
        {kSurface,
         {.name = "max-closing",
          .unit = "x extent",
          .help = "Drop faces that close what was looked at without support: that views hardly "
                  "see, or that turn off the surface, with an edge longer than this share of what "
                  "the views look at; 0 drops none and closes most gaps with large faces.",
          .max = 1.0},
         &surface.rules.max_closing},
        {kSurface,
         {.name = "closing-vast",
          .unit = "x closing edge",
          .help = "Drop such faces though views see them where they are this many times longer, "
                  "turn off the surface, and the surface ends at them.",
          .tuning = true},
         &surface.rules.vast},
        {kSurface,
         {.name = "closing-seen",
          .unit = "share",
          .help = "Drop such faces that turn off the surface if views see less of them.",
          .max = 1.0,
          .tuning = true},
         &surface.rules.half_seen},
        {kSurface,
         {.name = "hardly-seen",
          .unit = "share",
          .help = "Drop such faces, and others where the surface ends, if views see less of them.",
          .max = 1.0,
          .tuning = true},
         &surface.rules.hardly_seen},
        {kSurface,
         {.name = "trim",
          .unit = "x closing edge",
          .help = "Trim faces with a longer edge than that to what views see of them; 0 trims "
                  "none.",
          .tuning = true},
         &surface.rules.trim},
        {kSurface,
         {.name = "beside-edge",
          .unit = "x local edge",
          .help = "Keep faces that no view sees beside seen ones if no edge is this many times "
                  "longer than the median around; 0 keeps none.",
          .tuning = true},
         &surface.rules.beside_edge},
        {kSurface,
         {.name = "beside-length",
          .unit = "x median edge",
          .help = "And no edge is this many times longer than the longest one of the median face.",
          .tuning = true},
         &surface.rules.beside_length},
    };
}

OptionList mending_options(Options& options)
{
    return {
        {kSurface,
         {.name = "min-component",
          .unit = "faces",
          .help = "Remove pieces of the surface with fewer faces, or of half as many if they are "
                  "closed and have no long faces; 0 keeps all."},
         &options.surface.cleanup.min_component_faces},
        {kSurface,
         {.name = "max-hole",
          .unit = "edges",
          .help = "Fill holes with at most this many boundary edges; 0 fills none."},
         &options.surface.cleanup.max_hole_edges},
        {kSurface,
         {.name = "smooth",
          .unit = "iterations",
          .help = "Smooth the surface so often, never so that a face hides a point from a view "
                  "that it did not hide; 0 leaves it as it is.",
          .max = 1000},
         &options.refine.smooth.iterations},
        {kSurface,
         {.name = "simplify",
          .unit = "faces",
          .help = "Merge vertices until so many faces are left, never so that a face hides a "
                  "point from a view that it did not hide; 0 keeps all."},
         &options.refine.simplify.faces},
    };
}

OptionList run_options(Options& options)
{
    return {
        {kRunStage,
         {.name = "threads",
          .unit = "threads",
          .help = "How many to use; 0 uses all. The surface is the same for any.",
          .max = 1024},
         &options.threads},
        {kRunStage,
         {.name = "max-memory",
          .help = "How much memory a run may take: bytes, or with K, M or G. A larger model is "
                  "meshed in blocks, with files in --work; the surface is the same. auto: 80 % of "
                  "what the machine or its control group has free; 0 has no limit.",
          .words = {"auto"},
          .word_value = static_cast<double>(MemoryOptions::kAutoMemory)},
         &options.memory.most},
        {kRunStage,
         {.name = "blocks",
          .unit = "blocks",
          .help = "How many to cut the model into, with what does not fit into memory in files of "
                  "--work. auto: as many as --max-memory makes necessary; 0 works in memory, and "
                  "refuses a model that needs more.",
          .max = 65536.0,
          .words = {"auto"},
          .word_value = static_cast<double>(MemoryOptions::kAutoBlocks),
          .tuning = true},
         &options.memory.blocks},
    };
}

} // namespace

OptionList options_of(Options& options)
{
    LabelOptions& labels = options.labels;
    return joined({filter_options(options.points), added_point_options(options.added_points),
                   cloud_options(options), method_options(labels), weight_options(labels.trace),
                   depth_options(labels.trace), cut_options(labels),
                   virtual_view_options(labels.virtual_views), surface_options(options.surface),
                   mending_options(options), run_options(options)});
}

OptionList options_of(CompareOptions& options)
{
    constexpr const char* kStage = "Measure";
    return {
        {kStage,
         {.name = "samples",
          .help = "Points sampled on each mesh and on the seen part of the truth.",
          .min = 1000,
          .max = 100000000},
         &options.samples},
        {kStage, {.name = "seed", .help = "Where the sampling starts; any number."}, &options.seed},
        {kStage,
         {.name = "spacings",
          .unit = "x spacing",
          .help = "How far from a point, in spacings of the points around it, a mesh may pass and "
                  "still count as passing through it."},
         &options.spacings},
    };
}

} // namespace vcarve
