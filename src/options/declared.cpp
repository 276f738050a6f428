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

/// An option for C++ and Python only. `info` has name, unit and help.
Option for_library(const char* stage, OptionInfo info, OptionValue value, double max = kUnlimited)
{
    info.max = max;
    info.level = library;
    return {stage, std::move(info), std::move(value)};
}

OptionList photo_options(Options& options)
{
    return {
        {kPhotoStage,
         {.name = "dense",
          .help = "Compute dense points from photographs. The photographs are in "
                  "--images, or in the folder `images` beside the model."},
         &options.dense.dense},
        {kPhotoStage,
         {.name = "dense-size",
          .unit = "px",
          .help = "Scale the longest side of photographs to N pixels for matching. Depth is "
                  "measured at every second pixel; time grows with the square of N.",
          .min = 100,
          .max = 10000,
          .level = advanced},
         &options.dense.size_px},
        {kPhotoStage,
         {.name = "refine-size",
          .unit = "px",
          .help = "Scale the longest side of photographs to N pixels to refine the surface; 0 "
                  "disables. Time grows with the square of N.",
          .min = 0,
          .max = 10000,
          .level = advanced},
         &options.dense.refine_px},
        {kPhotoStage,
         {.name = "texture",
          .help = "Write a texture made of the photographs. They are in --images, or in the folder "
                  "`images` beside the model. The texture is in OUT.glb, or in JPEG files beside "
                  "OUT.obj or OUT.ply."},
         &options.texture.texture},
        {kPhotoStage,
         {.name = "texture-scale",
          .help = "Scale the texture to N texels per pixel of the photographs, along a side.",
          .min = 0.01,
          .max = 4.0,
          .level = advanced},
         &options.texture.scale},
        {kPhotoStage,
         {.name = "images",
          .unit = "folder",
          .help = "Use the photographs in FOLDER. Vertices get colors that the photographs agree "
                  "on, instead of single pixels'."},
         &options.images},
        {kPhotoStage,
         {.name = "masks",
          .unit = "folder",
          .help = "Exclude the black pixels of FOLDER/NAME.png from photograph NAME, as COLMAP "
                  "does. They give neither colors nor dense points, and faces that most views see "
                  "only in such pixels are removed.",
          .level = advanced},
         &options.masks.folder},
    };
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
          .help = "Drop points with a larger error in px. The error is the mean reprojection "
                  "error; 0 disables."},
         &points.max_error_px},
        {kPoints,
         {.name = "min-angle",
          .unit = "deg",
          .help = "Drop points whose rays all meet at a smaller angle in degrees; 0 disables.",
          .max = 180.0,
          .level = advanced},
         &points.min_angle_deg},
        {kPoints,
         {.name = "stray-spacing",
          .unit = "times",
          .help = "Drop two-view points isolated by more than N median spacings, as seen from "
                  "their views. The limit is 2/3 N for points of large error, 1.75 N for points "
                  "of small error; 0 disables.",
          .level = advanced},
         &points.stray_spacing},
    };
}

OptionList added_point_options(AddedPointOptions& added)
{
    return {
        for_library(kPoints,
                    {"crease-reach", "x spacing",
                     "Add points at creases of regions that end within N spacings; 0 disables."},
                    &added.crease_reach, 1000.0),
        for_library(kPoints,
                    {"border-gap", "x spacing",
                     "Add points at borders that rays pass within N spacings; 0 disables."},
                    &added.border_gap, 100.0),
        for_library(kPoints,
                    {"textureless-step", "x spacing",
                     "Add points N spacings apart in textureless regions; 0 disables."},
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
                  "the point at the largest scale; 0 disables.",
          .max = 1000.0,
          .level = advanced},
         &options.thin.merge_px},
        {kPoints,
         {.name = "crop",
          .help = "Reconstruct only this region. auto: the ball that holds the points of 94 % of "
                  "the rays. A box: x0,y0,z0,x1,y1,z1. A file: a closed surface (PLY), or text "
                  "with x and y of one polygon corner per line, for all z.",
          .words = {"none", "auto"}},
         &options.crop.region},
        {kPoints,
         {.name = "denoise",
          .unit = "sigma",
          .help = "Denoise by at most N sigma. Points of a dense cloud, or vertices of a sparse "
                  "model's mesh, move by at most N standard deviations of their error; 0 "
                  "disables.",
          .max = 100.0},
         &options.denoise.denoise},
    };
}

OptionList method_options(LabelOptions& options)
{
    OptionList list = {
        {kRays,
         {.name = "method",
          .help = "Select the labeling method. cut: a minimum cut, which contradicts the rays "
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
                     "Set s of the weight 1 - exp(-n^2 / 2 s^2) for n views; 0: equal weights."},
                    &trace.views_sigma, 100.0),
        for_library(kRays,
                    {"error-sigma", "x median error",
                     "Set s of the factor exp(-(e^2 - 1) / 2 s^2) for errors e > 1; 0 disables."},
                    &trace.error_sigma, 1000.0),
        for_library(kRays,
                    {"distance-sigma", "x short edge",
                     "Set the uncertainty of points along their rays; 0 disables."},
                    &trace.distance_sigma, 1000.0),
        for_library(kRays,
                    {"sink-depth", "x distance sigma",
                     "Set the depth behind points that gets inside votes; 0: the next cell only."},
                    &trace.sink_depth, 1000.0),
        for_library(
            kRays,
            {"bundle-rays", "rays", "Merge N neighboring rays of a dense cloud; 1 disables."},
            &trace.bundle_rays, 64),
        for_library(kRays,
                    {"inferred-rays", "weight",
                     "Set the weight of rays of views that likely saw a dense point; 0 disables."},
                    &trace.inferred_rays, 10.0),
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
          .help = "Set the cost of a badly shaped facet in the cut, in rays of full weight; 0 "
                  "disables.",
          .max = 100'000.0,
          .level = advanced},
         &options.cut.quality},
        for_library(kRays,
                    {"hull-edge", "x local edge",
                     "Continue the surface along the hull by edges of at most N; 0 disables."},
                    &options.hull.hull_edge),
        {kRays,
         {.name = "virtual-views",
          .unit = "views",
          .help = "Place N virtual viewpoints in space known to be free, and label the cells "
                  "again; 100 suit some thousand points; 0 disables.",
          .max = 10'000,
          .level = advanced},
         &views.count},
        for_library(kRays,
                    {"virtual-weight", "rays",
                     "Set the weight of a virtual viewpoint's ray, relative to a real ray."},
                    &views.weight, 100.0),
    };
}

OptionList surface_options(SurfaceOptions& surface)
{
    FaceRules& rules = surface.rules;
    return {
        {kSurface,
         {.name = "closed", .help = "Make a watertight mesh. Faces that no view sees are kept."},
         &surface.closed},
        {kSurface,
         {.name = "max-closing",
          .unit = "x extent",
          .help = "Drop long, unseen faces. A face is long if it has an edge above N times the "
                  "diameter of the region of interest. It is dropped if views see little of it, or "
                  "if it bends away from the surface; 0 disables, so large faces close most gaps. "
                  "auto: 0.115, or 0.02 with --dense.",
          .max = 1.0,
          .words = {"auto"},
          .word_value = FaceRules::kAutoClosing},
         &rules.max_closing},
        for_library(kSurface,
                    {"rim-closing", "x closing edge",
                     "Drop visible faces at the rim that bend away if an edge is above N."},
                    &rules.rim_closing),
        for_library(kSurface,
                    {"half-seen", "share",
                     "Drop long faces that bend away if a smaller share is visible; 0 disables."},
                    &rules.half_seen, 1.0),
        {kSurface,
         {.name = "hardly-seen",
          .unit = "share",
          .help = "Drop long faces and faces at the rim if a smaller share is visible; 0 disables.",
          .max = 1.0,
          .level = advanced},
         &rules.hardly_seen},
        for_library(kSurface,
                    {"trim", "x closing edge",
                     "Trim faces with an edge above N to their visible part; 0 disables."},
                    &rules.trim),
        for_library(kSurface,
                    {"beside-edge", "x local edge",
                     "Keep unseen faces beside kept ones if no edge is above N; 0 disables."},
                    &rules.beside_edge),
        for_library(kSurface,
                    {"beside-length", "x median edge",
                     "Limit their edges also to N times the median longest edge of kept faces."},
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
          .help = "Remove connected components with fewer faces. The limit is half of that for "
                  "closed components without long faces; 0 disables.",
          .level = advanced},
         &cleanup.min_component},
        {kCleanup,
         {.name = "max-hole",
          .unit = "edges",
          .help = "Fill holes up to N edges. 0 disables.",
          .max = 1000}, // N edges need 16 N^2 bytes, N^3 steps and recursion depth N
         &cleanup.max_hole},
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
                  "rejected; 0 disables. auto: simplify meshes of dense points, mostly within a "
                  "quarter of the vertex spacing.",
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
          .help = "Limit the memory, such as to 8G. A larger model is divided into tiles, with "
                  "files in --work or beside the output. auto: 80 % of the free memory of the "
                  "machine or its control group; 0 disables.",
          .words = {"auto"},
          .word_value = static_cast<double>(MemoryOptions::kAutoMemory)},
         &options.memory.limit},
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
          .help = "Choose the input points. sparse: points of the model. dense: fused.ply of a "
                  "dense workspace. A PLY file: points in the model's frame. The default is dense "
                  "if fused.ply and fused.ply.vis exist.",
          .words = {"sparse", "dense"}},
         &arguments.points.points},
        {kInput,
         {.name = "visibility",
          .help = "Read the views of each point of a PLY file from FILE, which is in the format of "
                  "COLMAP's stereo_fusion. The default is the name of the PLY file plus .vis.",
          .level = advanced},
         &arguments.points.visibility},
        {kInput,
         {.name = "rays",
          .help = "Choose the views of each point. file: the views in the model's tracks or in the "
                  "file of --visibility. nearest: the nearest views with an unobstructed line to "
                  "the point. auto: file, or nearest if most points of a model have fewer than "
                  "two views.",
          .words = {"auto", "file", "nearest"},
          .level = advanced},
         value_of_enum(arguments.points.rays)},
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
    return joined({photo_options(options), filter_options(options.points),
                   added_point_options(options.added_points), cloud_options(options),
                   method_options(labels), trace_options(labels.trace), cut_options(labels),
                   surface_options(options.surface), cleanup_options(options),
                   run_options(options)});
}

Option up_option(WordOrVector& up)
{
    return {
        "Output",
        {.name = "up",
         .help =
             "Set the up direction of .glb, which becomes y, and record it in the file. auto: up "
             "in most cameras. back: opposite to the cameras' view, for cameras that look "
             "straight down. z, or x,y,z: a direction in output coordinates. none: keep y.",
         .min = -kUnlimited,
         .words = {"auto", "back", "z", "none"},
         .level = advanced},
        &up};
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
         {.name = "seed", .help = "Set the seed of the sampling.", .level = advanced},
         &options.seed},
        {kStage,
         {.name = "spacings",
          .unit = "x spacing",
          .help = "Set the tolerance between mesh and points, in spacings of the points around.",
          .level = advanced},
         &options.spacings},
    };
}

} // namespace vcarve
