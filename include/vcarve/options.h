#pragma once

#include "vcarve/region.h"

#include <cstdint>

namespace vcarve {

/// Which points are good enough to carve with.
struct FilterOptions {
    int min_views = 2;           ///< points seen by fewer views are dropped
    double max_error_px = 4.0;   ///< points with a larger mean reprojection error are dropped; 0:
                                 ///< none
    double min_angle_deg = 1.0;  ///< points whose sights all meet at a smaller angle are dropped
    double stray_spacing = 16.0; ///< points of two views this many times the usual spacing away
                                 ///< from others are dropped; 0: none
};

/// Where points are added to planar regions of the surface; 0 adds none. All are multiples of the
/// spacing of the points of that region.
struct AddedPointOptions {
    double crease_reach = 28.0;    ///< where two regions meet: how far both may end from that line
    double border_gap = 3.0;       ///< where a region ends: how near to it sights pass by
    double textureless_step = 2.0; ///< amid one, where images show no features: how far apart

    /// Whether points are added anywhere.
    bool add_any() const
    {
        return crease_reach > 0.0 || border_gap > 0.0 || textureless_step > 0.0;
    }
};

/// Which points of a dense cloud become one.
struct ThinOptions {
    double merge_px = 1.8; ///< those within so many pixels of the images that show them largest; 0:
                           ///< none
};

/// Which part of space the surface is wanted of.
struct CropOptions {
    RegionChoice region; ///< what lies outside only carves
};

/// How far the points of a dense cloud are moved, or the vertices of a sparse one's surface.
struct DenoiseOptions {
    double denoise = 2.0; ///< standard deviations of the point itself, at most; 0: not at all
};

/// How much a sight says, and how far behind its point.
struct TraceOptions {
    double views_sigma = 1.5;    ///< s of the weight 1 - exp(-n^2 / 2 s^2) of a point of n views
                                 ///< against the median point's; 0: all weigh the same
    double distance_sigma = 0.5; ///< uncertainty of a point along its sights, in short edges; 0:
                                 ///< none
    double sink_depth = 0.0;     ///< how far behind a point its sights call the space inside, in
                                 ///< these uncertainties; 0: the cell that begins there
    double error_sigma = 3.0;    ///< s of the factor exp(-(e^2 - 1) / 2 s^2) of a point whose error
                                 ///< is e > 1 medians; 0: none
    int bundle_sights = 5;       ///< this many near sights of a dense cloud go on as one far from
                                 ///< their points; 1: each by itself
    double inferred_weight = 1.0; ///< of a sight that a dense cloud's file leaves out, where views
                                  ///< likely saw a point (inferred_sights); 0: none
};

/// How the minimum cut weighs shapes against sights.
struct CutOptions {
    double quality = 1.0; ///< what a badly shaped facet costs, in sights of full weight
};

/// Where the surface goes on along the hull of the points, where they are seen from within only.
struct HullOptions {
    double hull_edge =
        20.0; ///< by faces of edges up to so many times the median around; 0: nowhere
};

/// How many more viewpoints are tried, and how much they count.
struct VirtualViewOptions {
    int count = 0;       ///< placed where sights have shown space to be free
    double weight = 0.5; ///< of a sight of theirs, relative to a real one of the same point
};

/// How cells are told outside from inside.
enum class Method {
    cut,   ///< the labelling that contradicts the sights least
    strict ///< every cell that a sight crosses is outside, for points without noise
};

/// Everything that decides which cells are inside.
struct LabelOptions {
    Method method = Method::cut;      ///< how
    int min_crossings = 1;            ///< strict: of a facet, to carve the cells beside it
    TraceOptions trace;               ///< what a sight says
    CutOptions cut;                   ///< the minimum cut
    HullOptions hull;                 ///< where no cells lie behind
    VirtualViewOptions virtual_views; ///< viewpoints beside the model's
};

/// The thresholds of the rule book, which says which faces of the boundary are surface
/// (src/steps/6_surface/face_rules.h).
struct FaceRules {
    double max_closing = 0.115; ///< a longest edge of so much of the diameter of the region of
                                ///< interest makes a face long; 0: no face that views see is
                                ///< dropped or trimmed
    double vast = 2.0;          ///< x that: longer faces go even if seen, where the surface ends
    double half_seen = 0.5;     ///< long faces that turn off go if a smaller share is seen
    double hardly_seen = 0.12;  ///< faces that are long or at an end go if a smaller share is seen
    double trim = 0.5;          ///< x long: from this longest edge on faces are trimmed; 0: none
    double beside_edge = 3.0;   ///< unseen faces beside kept ones stay up to a longest edge of so
                                ///< many times the median edge around; 0: none
    double beside_length = 8.0; ///< and of so many times that of the median kept face
};

/// What is mended, and what is thrown away.
struct CleanupOptions {
    int min_component_faces = 6; ///< pieces with fewer faces are removed; 0: none
    int max_hole_edges = 12;     ///< holes with at most so many edges are filled; 0: none. At most
                                 ///< 1000: N edges take 16 N^2 bytes and N^3 steps
};

/// Which faces of the boundary are kept, and how the surface is mended.
struct SurfaceOptions {
    bool closed = false;    ///< faces that no view sees are kept, so that nothing is open
    FaceRules rules;        ///< which faces are surface
    CleanupOptions cleanup; ///< mending
};

/// How far vertices are moved.
struct SmoothOptions {
    int iterations = 0; ///< how often; no face hides a point from a view that it did not hide
};

/// How far vertices are merged.
struct SimplifyOptions {
    static constexpr int kAutoFaces = -1; ///< of a dense surface as many as its noise allows

    int faces = kAutoFaces; ///< number of faces that are left; 0 keeps all. With a number, a merge
                            ///< that would occlude an observed point is rejected.
};

/// How vertices are moved and merged; by default neither is done.
struct RefineOptions {
    SmoothOptions smooth;     ///< moving vertices
    SimplifyOptions simplify; ///< merging vertices
};

/// How a run gets by with the memory there is.
struct MemoryOptions {
    static constexpr int kAutoBlocks = -1;          ///< as many as `most` makes necessary
    static constexpr std::int64_t kAutoMemory = -1; ///< 80 % of what is free

    std::int64_t most = kAutoMemory; ///< bytes that the run may take; 0: no limit
    int blocks = kAutoBlocks;        ///< that the model is cut into, with files beside; 0: none
};

/// Everything a run can be told, step by step.
struct Options {
    FilterOptions points;           ///< which points are kept
    AddedPointOptions added_points; ///< where points are added
    ThinOptions thin;               ///< which points become one
    CropOptions crop;               ///< which part of space counts
    DenoiseOptions denoise;         ///< how far points move
    LabelOptions labels;            ///< which cells are inside
    SurfaceOptions surface;         ///< which faces are kept
    RefineOptions refine;           ///< what is done to the surface
    int threads = 0;                ///< how many are used, 0: all; the surface is the same for any
    MemoryOptions memory;           ///< how much of it is taken
};

} // namespace vcarve
