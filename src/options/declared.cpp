#include "options/declared.h"

#include <utility>

namespace vcarve {

namespace {

using enum OptionLevel;

constexpr const char* kInput = "Input";
constexpr const char* kPoints = "Point";
constexpr const char* kRays = "Ray";
constexpr const char* kSurface = "Surface";
constexpr const char* kCleanup = "Cleanup";

/// An option of C++ and Python only. The info has name, unit and help.
Option for_library(const char* stage, OptionInfo info, OptionValue value, double max = kUnlimited)
{
    info.max = max;
    info.level = library;
    return {stage, std::move(info), std::move(value)};
}

OptionList filter_options(FilterOptions& points)
{
    return {
        {kPoints,
         {.name = "min-views", .unit = "views", .help = "Drop points with fewer views.", .min = 1},
         &points.min_views},
        {kPoints,
         {.name = "max-error",
          .unit = "px",
          .help = "Drop points with a larger error in px. The mean reprojection error counts; 0 "
                  "keeps all."},
         &points.max_error_px},
        {kPoints,
         {.name = "min-angle",
          .unit = "deg",
          .help = "Drop points whose rays all meet at a smaller angle in degrees; 0 keeps all.",
          .max = 180.0,
          .level = advanced},
         &points.min_angle_deg},
        {kPoints,
         {.name = "stray-spacing",
          .unit = "times",
          .help = "Drop two-view points isolated by more than N median spacings, as seen from "
                  "their views. The limit is 2/3 N for points of large error, 1.75 N for points "
                  "of small error; 0 keeps all.",
          .level = advanced},
         &points.stray_spacing},
    };
}

OptionList added_point_options(AddedPointOptions& added)
{
    return {
        for_library(kPoints,
                    {"crease-reach", "x spacing",
                     "Add points at creases of regions that end within N spacings; 0: none."},
                    &added.crease_reach, 1000.0),
        for_library(kPoints,
                    {"border-gap", "x spacing",
                     "Add points at borders that rays pass within N spacings; 0: none."},
                    &added.border_gap, 100.0),
        for_library(kPoints,
                    {"textureless-step", "x spacing",
                     "Add points N spacings apart in textureless regions; 0: none."},
                    &added.textureless_step, 100.0),
    };
}

OptionList cloud_options(Options& options)
{
    return {
        {kPoints,
         {.name = "merge-px",
          .unit = "px",
          .help = "Merge points of a dense cloud within N px, measured in the view that images "
                  "the point at the largest scale; 0 merges none.",
          .max = 1000.0,
          .level = advanced},
         &options.thin.merge_px},
        {kPoints,
         {.name = "crop",
          .help = "Reconstruct only this region. auto: the ball in which 94 % of the rays end. A "
                  "box: x0,y0,z0,x1,y1,z1. A file: PLY with a closed surface, or text with the x "
                  "and y of a polygon's corner per line, for all z.",
          .words = {"none", "auto"}},
         &options.crop.region},
        {kPoints,
         {.name = "denoise",
          .unit = "sigma",
          .help = "Denoise by at most N sigma. Points of a dense cloud, or vertices of a sparse "
                  "model's mesh, move by at most N standard deviations of their error; 0 moves "
                  "none.",
          .max = 100.0},
         &options.denoise.denoise},
    };
}

OptionList method_options(LabelOptions& options)
{
    OptionList list = {
        {kRays,
         {.name = "method",
          .help = "Choose how cells are labeled. cut: a minimum cut that contradicts the rays "
                  "least. strict: every cell that a ray crosses is outside, for noise-free points.",
          .words = {"cut", "strict"},
          .level = advanced},
         value_of_enum(options.method)},
        for_library(kRays,
                    {"min-crossings", "rays",
                     "Carve the cells beside a facet if N rays cross it (strict method)."},
                    &options.min_crossings),
    };
    list.back().info.min = 1;
    return list;
}

OptionList trace_options(TraceOptions& trace)
{
    OptionList list = {
        for_library(kRays,
                    {"views-sigma", "views",
                     "Set s of the ray weight 1 - exp(-n^2 / 2 s^2), n views; 0: all alike."},
                    &trace.views_sigma, 100.0),
        for_library(kRays,
                    {"error-sigma", "x median error",
                     "Set s of the factor exp(-(e^2 - 1) / 2 s^2) for errors e > 1; 0: none."},
                    &trace.error_sigma, 1000.0),
        for_library(kRays,
                    {"distance-sigma", "x short edge",
                     "Set the uncertainty of points along their rays; 0 trusts them fully."},
                    &trace.distance_sigma, 1000.0),
        for_library(kRays,
                    {"sink-depth", "x distance sigma",
                     "Set how far behind a point its rays vote for inside; 0: the next cell."},
                    &trace.sink_depth, 1000.0),
        for_library(
            kRays,
            {"bundle-sights", "rays", "Merge N neighboring rays of a dense cloud; 1 merges none."},
            &trace.bundle_sights, 64),
        for_library(kRays,
                    {"inferred-sights", "weight",
                     "Weigh rays of views that likely saw a dense point; 0 ignores them."},
                    &trace.inferred_weight, 10.0),
    };
    list[4].info.min = 1;
    return list;
}

OptionList cut_options(LabelOptions& options)
{
    VirtualViewOptions& views = options.virtual_views;
    return {
        {kRays,
         {.name = "quality",
          .unit = "rays",
          .help = "Set the cost of a badly shaped facet in the cut, in rays of full weight; 0 uses "
                  "rays only.",
          .max = 100'000.0,
          .level = advanced},
         &options.cut.quality},
        for_library(kRays,
                    {"hull-edge", "x local edge",
                     "Continue the surface along the hull by edges up to this; 0 does not."},
                    &options.hull.hull_edge),
        {kRays,
         {.name = "virtual-views",
          .unit = "views",
          .help = "Place N virtual viewpoints in space known to be free, and label the cells "
                  "again; 100 suit some thousand points, 0 places none.",
          .max = 10'000,
          .level = advanced},
         &views.count},
        for_library(kRays,
                    {"virtual-weight", "rays",
                     "Weigh a ray of a virtual viewpoint, relative to a real one."},
                    &views.weight, 100.0),
    };
}

OptionList surface_options(SurfaceOptions& surface)
{
    FaceRules& rules = surface.rules;
    return {
        {kSurface,
         {.name = "closed",
          .help = "Make a watertight mesh. Faces that no view sees are kept, too."},
         &surface.closed},
        {kSurface,
         {.name = "max-closing",
          .unit = "x extent",
          .help = "Drop long, unseen faces. A face is dropped if it has an edge longer than N "
                  "times the extent of what the views look at, and few views see it or it turns "
                  "off the surface; 0 drops none and closes most gaps with large faces.",
          .max = 1.0},
         &rules.max_closing},
        for_library(kSurface,
                    {"closing-vast", "x closing edge",
                     "Drop seen boundary faces that turn off the surface beyond this."},
                    &rules.vast),
        for_library(kSurface,
                    {"closing-seen", "share",
                     "Drop long faces that turn off the surface if seen less than this."},
                    &rules.half_seen, 1.0),
        {kSurface,
         {.name = "hardly-seen",
          .unit = "share",
          .help = "Drop long faces and boundary faces if views see a smaller share of them.",
          .max = 1.0,
          .level = advanced},
         &rules.hardly_seen},
        for_library(kSurface,
                    {"trim", "x closing edge",
                     "Trim faces with a longer edge to what views see of them; 0: none."},
                    &rules.trim),
        for_library(kSurface,
                    {"beside-edge", "x local edge",
                     "Keep unseen faces beside seen ones up to this edge; 0 keeps none."},
                    &rules.beside_edge),
        for_library(kSurface,
                    {"beside-length", "x median edge",
                     "Keep such faces only up to this multiple of the median longest edge."},
                    &rules.beside_length),
    };
}

OptionList cleanup_options(Options& options)
{
    CleanupOptions& cleanup = options.surface.cleanup;
    return {
        {kCleanup,
         {.name = "min-component",
          .unit = "faces",
          .help = "Remove components with fewer faces, or with half as many if they are closed "
                  "and have no long faces; 0 keeps all.",
          .level = advanced},
         &cleanup.min_component_faces},
        {kCleanup,
         {.name = "max-hole",
          .unit = "edges",
          .help = "Fill holes up to N edges. 0 fills none.",
          .max = 1000}, // N edges take 16 N^2 bytes, N^3 steps and a recursion N deep
         &cleanup.max_hole_edges},
        {kCleanup,
         {.name = "smooth",
          .unit = "iterations",
          .help = "Smooth N times. A move that would occlude an observed point is rejected.",
          .max = 1000},
         &options.refine.smooth.iterations},
        {kCleanup,
         {.name = "simplify",
          .unit = "faces",
          .help = "Simplify to about N faces. A merge that would occlude an observed point is "
                  "rejected; 0 keeps all faces. auto: simplify surfaces of dense points within a "
                  "quarter of their spacing.",
          .words = {"auto"},
          .word_value = SimplifyOptions::kAutoFaces},
         &options.refine.simplify.faces},
    };
}

OptionList run_options(Options& options)
{
    return {
        {kRunStage,
         {.name = "threads",
          .unit = "threads",
          .help = "Use N threads. 0 uses all. Output is byte-identical for any thread count.",
          .max = 1024},
         &options.threads},
        {kRunStage,
         {.name = "max-memory",
          .help = "Limit the memory, such as 8G. A larger model is meshed in blocks, with files "
                  "in --work; the mesh is the same. auto: 80 % of the free memory of the machine "
                  "or its control group; 0 has no limit.",
          .words = {"auto"},
          .word_value = static_cast<double>(MemoryOptions::kAutoMemory)},
         &options.memory.most},
        {kRunStage,
         {.name = "blocks",
          .unit = "blocks",
          .help = "Cut the model into N blocks, with arrays in files of --work. auto: as many as "
                  "--max-memory makes necessary. 0: work in memory, and refuse a model that needs "
                  "more.",
          .max = 65536.0,
          .words = {"auto"},
          .word_value = static_cast<double>(MemoryOptions::kAutoBlocks),
          .level = advanced},
         &options.memory.blocks},
    };
}

} // namespace

PointsOptions PointsArguments::all_points() const
{
    PointsOptions all = points;
    if (scanner.word == WordOrVector::kNoWord) all.scanner = scanner.vector;
    return all;
}

OptionList options_of(PointsArguments& arguments)
{
    return {
        {kInput,
         {.name = "points",
          .unit = "file",
          .help = "Choose the input points. sparse: those of the model. dense: fused.ply of a "
                  "dense workspace. A PLY file: points in the model's frame. The default is dense "
                  "if fused.ply and fused.ply.vis exist.",
          .words = {"sparse", "dense"}},
         &arguments.points.points},
        {kInput,
         {.name = "visibility",
          .help = "Read which views saw the points of a PLY file, as COLMAP's stereo_fusion "
                  "writes it; by default from the file of the same name with .vis appended.",
          .level = advanced},
         &arguments.points.visibility},
        {kInput,
         {.name = "sights",
          .help = "Choose which views saw a point. file: those in the model's tracks or in the "
                  "file of --visibility. nearest: the nearest views with an unobstructed line to "
                  "the point. auto: file, or nearest if most points of a model have fewer than "
                  "two views.",
          .words = {"auto", "file", "nearest"},
          .level = advanced},
         value_of_enum(arguments.points.sights)},
        {kInput,
         {.name = "scanner",
          .help = "Set the scanner position. It applies to all points of a PLY file, in its "
                  "coordinates, and no model is needed. file: read it from the PLY file, per "
                  "point (x_origin, y_origin, z_origin, or scanner_x ...) or once (PCL's element "
                  "camera).",
          .min = -kUnlimited,
          .words = {"file"}},
         &arguments.scanner},
    };
}

OptionList options_of(Options& options)
{
    LabelOptions& labels = options.labels;
    return joined({filter_options(options.points), added_point_options(options.added_points),
                   cloud_options(options), method_options(labels), trace_options(labels.trace),
                   cut_options(labels), surface_options(options.surface), cleanup_options(options),
                   run_options(options)});
}

OptionList options_of(CompareOptions& options)
{
    constexpr const char* kStage = "Measurement";
    return {
        {kStage,
         {.name = "samples",
          .help = "Sample N points on each mesh and on the visible part of the truth.",
          .min = 1000,
          .max = 100000000,
          .level = advanced},
         &options.samples},
        {kStage,
         {.name = "seed", .help = "Seed the sampling with any number.", .level = advanced},
         &options.seed},
        {kStage,
         {.name = "spacings",
          .unit = "x spacing",
          .help = "Count a mesh as passing through a point within N spacings of the points around "
                  "it.",
          .level = advanced},
         &options.spacings},
    };
}

} // namespace vcarve
