#pragma once

#include "vcarve/option_visitor.h"
#include "vcarve/region.h"

#include <array>
#include <cstdint>

namespace vcarve {

/// Which points are good enough to carve with.
struct FilterOptions {
    int min_views = 2;           ///< --min-views
    double max_error_px = 4.0;   ///< --max-error
    double min_angle_deg = 1.0;  ///< --min-angle
    double stray_spacing = 16.0; ///< --stray-spacing

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.stage("Points");
        options.count(min_views, {.name = "min-views",
                                  .unit = "views",
                                  .help = "Drop points seen by fewer views.",
                                  .min = 1});
        options.number(
            max_error_px,
            {.name = "max-error",
             .unit = "px",
             .help = "Drop points whose mean reprojection error is larger; 0 keeps all."});
        options.number(
            min_angle_deg,
            {.name = "min-angle",
             .unit = "deg",
             .help = "Drop points whose sights all meet at a smaller angle; 0 keeps all.",
             .max = 180.0});
        options.number(stray_spacing,
                       {.name = "stray-spacing",
                        .unit = "times",
                        .help = "Drop points of two views that stand this many times the usual "
                                "spacing away from others, as seen from their views, or two thirds "
                                "of that where their error is large; 0 keeps all."});
    }
};

/// Where points are added.
struct CreaseOptions {
    double reach = 28.0;     ///< --crease-reach
    double border_gap = 3.0; ///< --border-gap
    double blank_step = 2.0; ///< --blank-step

    /// Whether points are added anywhere.
    bool add_any() const { return reach > 0.0 || border_gap > 0.0 || blank_step > 0.0; }

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.number(reach,
                       {.name = "crease-reach",
                        .unit = "x spacing",
                        .help = "Add points where two flat parts of the surface meet and both have "
                                "points no farther than so many times their spacing from there, as "
                                "at the foot of a wall, where images show no features; 0 adds "
                                "none.",
                        .max = 1000.0});
        options.number(border_gap,
                       {.name = "border-gap",
                        .unit = "x spacing",
                        .help = "Add points where a flat part of the surface ends and sights pass "
                                "by no farther than so many times the spacing of its points, as "
                                "at the eaves of a roof; 0 adds none.",
                        .max = 100.0});
        options.number(blank_step,
                       {.name = "blank-step",
                        .unit = "x spacing",
                        .help = "Add points so many times their spacing apart amid a flat part of "
                                "the surface where views look at it but images show no features, "
                                "as on a plain floor; 0 adds none.",
                        .max = 100.0});
    }
};

/// Which points of a dense cloud become one.
struct ThinOptions {
    double merge_px = 1.8; ///< --merge-px

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.number(
            merge_px,
            {.name = "merge-px",
             .unit = "px",
             .help = "Merge points of a dense cloud, those without a reprojection error, that lie "
                     "within so many pixels of the images that show them largest; 0 merges none.",
             .max = 1000.0});
    }
};

/// Which part of space the surface is wanted of.
struct CropOptions {
    RegionChoice region; ///< --crop

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.region(
            region,
            {.name = "crop",
             .help =
                 "Make the surface of a region only, given in the model's coordinates: auto, "
                 "the ball in which 94 % of the sights end; a box x0,y0,z0,x1,y1,z1; a PLY file "
                 "with a closed surface; or a text file with the x and y of a corner of a "
                 "polygon a line, for all z. What looks through the region still carves it; "
                 "none takes all."});
    }
};

/// How far the points of a dense cloud are moved, or the vertices of a sparse one's surface.
struct DenoiseOptions {
    double denoise = 2.0; ///< --denoise

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.number(
            denoise,
            {.name = "denoise",
             .unit = "sigma",
             .help = "Move points of a dense cloud, those without a reprojection error, within so "
                     "many standard deviations of their own to the surface that the points around "
                     "agree on; of a sparse model, the vertices of the finished surface (not with "
                     "--method strict). 0 moves none.",
             .max = 100.0});
    }
};

/// How much a sight says, and how far behind its point.
struct TraceOptions {
    double views_sigma = 1.5;    ///< --views-sigma
    double distance_sigma = 0.5; ///< --distance-sigma
    double sink_depth = 0.0;     ///< --sink-depth
    double error_sigma = 3.0;    ///< --error-sigma
    int bundle_sights = 5;       ///< --bundle-sights

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.stage("Sights");
        options.number(
            views_sigma,
            {.name = "views-sigma",
             .unit = "views",
             .help = "A sight weighs 1 - exp(-n^2 / 2 s^2) for a point of n views, relative to the "
                     "median point; 0 gives every sight the same weight.",
             .max = 100.0});
        options.number(
            error_sigma,
            {.name = "error-sigma",
             .unit = "x median error",
             .help =
                 "A sight weighs exp(-(e^2 - 1) / 2 s^2) of that for a point whose reprojection "
                 "error is e > 1 medians; 0 takes no account of errors.",
             .max = 1000.0});
        options.number(distance_sigma,
                       {.name = "distance-sigma",
                        .unit = "x short edge",
                        .help = "Uncertainty of a point along its sights, as a multiple of the "
                                "25th percentile of edge lengths; 0 trusts every point fully.",
                        .max = 1000.0});
        options.number(sink_depth,
                       {.name = "sink-depth",
                        .unit = "x distance sigma",
                        .help = "How far behind a point its sights call the space inside; "
                                "0 means the cell that begins at the point.",
                        .max = 1000.0});
        options.count(bundle_sights,
                      {.name = "bundle-sights",
                       .unit = "sights",
                       .help = "How many near sights of a dense cloud's points go on as one where "
                               "they are far from their points; 1 walks each to its view.",
                       .min = 1,
                       .max = 64});
    }
};

/// How the minimum cut weighs shapes against sights.
struct CutOptions {
    double quality = 1.0; ///< --quality

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.stage("Cut");
        options.number(quality,
                       {.name = "quality",
                        .unit = "sights",
                        .help = "What a badly shaped facet costs in the cut, in sights of full "
                                "weight; 0 lets only the sights decide.",
                        .max = 100'000.0});
    }
};

/// Where the surface goes on along the hull of the points.
struct HullOptions {
    double hull_edge = 20.0; ///< x the median edge around, up to there; 0: nowhere

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.number(hull_edge,
                       {.name = "hull-edge",
                        .unit = "x local edge",
                        .help =
                            "Let the surface go on along the hull of the points, where they are "
                            "seen from within only, by faces of edges up to this many times "
                            "the median around; 0 lets it end."});
    }
};

/// How many more viewpoints are tried, and how much they count.
struct VirtualViewOptions {
    int count = 0;       ///< --virtual-views
    double weight = 0.5; ///< --virtual-weight

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.stage("Virtual views");
        options.count(count, {.name = "virtual-views",
                              .unit = "views",
                              .help = "How many viewpoints to place in space that sights have "
                                      "shown to be free, to look from there at the points around "
                                      "and label the cells again; 100 suit some thousand points, 0 "
                                      "places none."});
        options.number(weight, {.name = "virtual-weight",
                                .unit = "sights",
                                .help = "What a sight of such a viewpoint counts, relative to a "
                                        "real sight of the same point.",
                                .max = 100.0});
    }
};

/// How cells are told outside from inside.
enum class Method { cut, strict };

/// Everything that decides which cells are inside.
struct LabelOptions {
    Method method = Method::cut;      ///< --method
    int min_crossings = 1;            ///< --min-crossings
    TraceOptions trace;               ///< what a sight says
    CutOptions cut;                   ///< the minimum cut
    HullOptions hull;                 ///< where no cells lie behind
    VirtualViewOptions virtual_views; ///< viewpoints beside the model's

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        static constexpr std::array<const char*, 2> kMethods = {"cut", "strict"};
        options.stage("Method");
        options.choice(
            method, kMethods,
            {.name = "method",
             .help = "cut: the labelling that contradicts the sights least. strict: every cell "
                     "a sight crosses is outside (for points without noise)."});
        options.count(min_crossings,
                      {.name = "min-crossings",
                       .unit = "sights",
                       .help = "With --method strict: how many sights must cross a facet "
                               "to carve the cells beside it.",
                       .min = 1});
        trace.visit(options);
        cut.visit(options);
        hull.visit(options);
        virtual_views.visit(options);
    }
};

/// The thresholds of the rule book, which says which faces of the boundary are surface
/// (src/steps/6_surface/face_rules.h).
struct FaceRules {
    double max_closing = 0.115; ///< a longer edge than this share of the diameter of the region of
                                ///< interest makes a face long; 0 drops no face that views see
    double vast = 2.0;          ///< so many times that for faces that views see
    double half_seen = 0.5;     ///< less than this share of a long face that turns off the surface
    double hardly_seen = 0.12;  ///< less than this share of any face
    double trim = 0.5;          ///< x long: from there on faces are trimmed; 0 trims none
    double beside_edge = 3.0;   ///< x the median edge around: unseen faces beside kept ones stay
                                ///< up to there; 0 keeps none
    double beside_length = 8.0; ///< x the longest edge of the median kept face, the same

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.number(max_closing,
                       {.name = "max-closing",
                        .unit = "x extent",
                        .help = "Drop faces that close what was looked at without support: with an "
                                "edge longer than this share of the region of interest, and hardly "
                                "seen or turning off the surface; 0 keeps them.",
                        .max = 1.0});
        options.number(trim, {.name = "trim",
                              .unit = "x closing edge",
                              .help = "Trim faces with a longer edge to what views see of them; 0 "
                                      "trims none.",
                              .max = 100.0});
        options.number(beside_edge,
                       {.name = "beside-edge",
                        .unit = "x local edge",
                        .help = "Keep faces that no view sees beside seen ones if no edge is this "
                                "many times longer than the median around; 0 keeps none."});
    }
};

/// What is mended, and what is thrown away. Switched off value by value.
struct CleanupOptions {
    int min_component_faces = 6; ///< --min-component
    int max_hole_edges = 12;     ///< --max-hole

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.count(min_component_faces,
                      {.name = "min-component",
                       .unit = "faces",
                       .help =
                           "Remove pieces of the surface with fewer faces, or of half as many if "
                           "they are closed and have no long faces; 0 keeps all."});
        options.count(max_hole_edges,
                      {.name = "max-hole",
                       .unit = "edges",
                       .help = "Fill holes with at most this many boundary edges; 0 fills none."});
    }
};

/// Which faces of the boundary are kept, and how the surface is mended.
struct SurfaceOptions {
    bool closed = false;    ///< --closed
    FaceRules rules;        ///< which faces are surface
    CleanupOptions cleanup; ///< mending

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.stage("Surface");
        options.flag(closed,
                     {.name = "closed",
                      .help = "Keep faces that no view supports, so that the surface is closed."});
        rules.visit(options);
        cleanup.visit(options);
    }
};

/// How far vertices are moved.
struct SmoothOptions {
    int iterations = 0; ///< --smooth

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.count(iterations,
                      {.name = "smooth",
                       .unit = "iterations",
                       .help = "Smooth the surface so often, never so that a face hides a point "
                               "from a view that it did not hide; 0 leaves it as it is.",
                       .max = 1000});
    }
};

/// How far vertices are merged.
struct SimplifyOptions {
    int faces = 0; ///< --simplify

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.count(faces, {.name = "simplify",
                              .unit = "faces",
                              .help = "Merge vertices until so many faces are left, never so that "
                                      "a face hides a point from a view that it did not hide; 0 "
                                      "keeps all."});
    }
};

/// How vertices are moved and merged; by default neither is done.
struct RefineOptions {
    SmoothOptions smooth;     ///< moving vertices
    SimplifyOptions simplify; ///< merging vertices

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        smooth.visit(options);
        simplify.visit(options);
    }
};

/// How a run gets by with the memory there is.
struct MemoryOptions {
    static constexpr int kAutoBlocks = -1;          ///< as many as --max-memory makes necessary
    static constexpr std::int64_t kAutoMemory = -1; ///< most of what is free

    std::int64_t most = kAutoMemory; ///< --max-memory, bytes; 0 has no limit
    int blocks = kAutoBlocks;        ///< --blocks; 0 works in memory

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        options.bytes(most, {.name = "max-memory",
                             .help = "How much memory a run may take, judging by its points and "
                                     "sights before work starts: bytes, or with K, M or G. A model "
                                     "that needs more is meshed in blocks; with --blocks 0 it is "
                                     "refused. auto: 80 % of what the machine or its control group "
                                     "has free; 0 has no limit.",
                             .word = "auto",
                             .word_value = static_cast<double>(kAutoMemory)});
        options.count(blocks, {.name = "blocks",
                               .unit = "blocks",
                               .help = "How many to cut the model into, with what does not fit "
                                       "into memory in files of --work; the surface is the same. "
                                       "auto: as many as --max-memory makes necessary; 0 works in "
                                       "memory.",
                               .max = 65536.0,
                               .word = "auto",
                               .word_value = static_cast<double>(kAutoBlocks)});
    }
};

/// Everything a run can be told, step by step.
struct Options {
    FilterOptions points;   ///< which points are kept
    CreaseOptions creases;  ///< where points are added
    ThinOptions thin;       ///< which points become one
    CropOptions crop;       ///< which part of space counts
    DenoiseOptions denoise; ///< how far points move
    LabelOptions labels;    ///< which cells are inside
    SurfaceOptions surface; ///< which faces are kept
    RefineOptions refine;   ///< what is done to the surface
    int threads = 0;        ///< --threads
    MemoryOptions memory;   ///< how much of it is taken

    /// Shows the visitor each of them.
    void visit(OptionVisitor& options)
    {
        points.visit(options);
        creases.visit(options);
        thin.visit(options);
        crop.visit(options);
        denoise.visit(options);
        labels.visit(options);
        surface.visit(options);
        refine.visit(options);
        options.stage("Run");
        options.count(threads,
                      {.name = "threads",
                       .unit = "threads",
                       .help = "How many to use; 0 uses all. The surface is the same for any.",
                       .max = 1024});
        memory.visit(options);
    }
};

} // namespace vcarve
