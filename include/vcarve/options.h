#pragma once

#include "vcarve/region.h"

#include <cstdint>
#include <filesystem>

namespace vcarve {

/// Dense points, computed from the photographs.
struct DenseOptions {
    bool dense = false;   ///< replace the sparse points by dense points
    int size_px = 640;    ///< longest side of the photographs while they are matched; higher gives
                          ///< more points, and takes time that grows with its square
    int refine_px = 1600; ///< longest side while the surface is refined; higher is sharper, and
                          ///< takes time that grows with its square; 0 disables
};

/// Masks of the photographs.
struct MaskOptions {
    /// Folder with NAME.png for the photograph NAME, whose black pixels are excluded: they give no
    /// colors and dense points, and faces that most views see only there are removed. Empty: none.
    std::filesystem::path folder;
};

/// Texture made of the photographs.
struct TextureOptions {
    bool texture = false; ///< make a texture
    double scale = 1.0;   ///< texels per photograph pixel, along a side; higher needs more memory
};

/// Filter for input points.
struct FilterOptions {
    int min_views = 2;         ///< minimum number of views per point; higher drops more
    double max_error_px = 4.0; ///< maximum mean reprojection error in px; higher drops fewer
                               ///< points; 0 disables
    /// Minimum of the widest ray angle of a point, in degrees; higher drops more; 0 disables.
    double min_angle_deg = 1.0;
    /// Maximum isolation of two-view points, in median spacings; higher drops fewer; 0 disables.
    double stray_spacing = 16.0;
};

/// Points added on planar regions. The unit is the region's median point spacing; 0 disables each.
struct AddedPointOptions {
    double crease_reach = 28.0;    ///< maximum distance of regions to a crease; higher adds more
    double border_gap = 3.0;       ///< maximum distance of rays to a border; higher adds more
    double textureless_step = 2.0; ///< point spacing in textureless areas; higher adds fewer

    /// Whether any points are added.
    bool add_any() const
    {
        return crease_reach > 0.0 || border_gap > 0.0 || textureless_step > 0.0;
    }
};

/// Merging of dense points.
struct ThinOptions {
    double merge_px = 1.8; ///< merge radius in px, in the view that images the point at the largest
                           ///< scale; higher merges more; 0 disables
};

/// Region to reconstruct.
struct CropOptions {
    RegionChoice region; ///< rays of points outside only mark free space
};

/// Denoising of dense points, or of the vertices of a sparse model's mesh.
struct DenoiseOptions {
    double denoise = 2.0; ///< maximum move in standard deviations; higher flattens more; 0 disables
};

/// Weights of rays.
struct TraceOptions {
    double views_sigma = 1.5;    ///< s of the weight 1 - exp(-n^2 / 2 s^2) of n views, relative to
                                 ///< the median point; higher favors many views; 0 disables
    double distance_sigma = 0.5; ///< uncertainty along rays, in 25th percentiles of edge lengths;
                                 ///< higher lowers weights near points; 0 disables
    double sink_depth = 0.0;     ///< depth of votes for inside, in this uncertainty; higher
                                 ///< thickens solids; 0 votes only for the cell behind the point
    double error_sigma = 3.0;    ///< s of the factor exp(-(e^2 - 1) / 2 s^2) for e > 1 median
                                 ///< errors; higher trusts inexact points more; 0 disables
    int bundle_rays = 5;         ///< number of neighboring rays of a dense cloud that merge far
                                 ///< from their points; higher is faster, less exact; 1 disables
    double inferred_rays = 1.0;  ///< weight of rays missing in a dense cloud's file
                                 ///< (inferred_rays.h); higher proves more free space; 0 disables
};

/// Options of the minimum cut.
struct CutOptions {
    double quality = 1.0; ///< cost of a badly shaped facet, in rays of full weight; higher prefers
                          ///< well-shaped faces to agreement with rays; 0 disables
};

/// Continuation of the surface along the convex hull, where views see it from inside only.
struct HullOptions {
    double hull_edge = 20.0; ///< maximum edge of such faces, in local median edge lengths; higher
                             ///< closes more; 0 disables
};

/// Additional viewpoints.
struct VirtualViewOptions {
    int count = 0; ///< number of viewpoints in known free space; higher frees more; 0 disables
    double weight = 0.5; ///< weight of their rays, relative to a real ray; higher frees more
};

/// Labeling method.
enum class Method {
    cut,   ///< the labeling that contradicts the rays least
    strict ///< every cell that a ray crosses is outside, for points without noise
};

/// Labeling of cells as inside or outside.
struct LabelOptions {
    Method method = Method::cut;      ///< labeling method
    int min_crossings = 1;            ///< strict: rays through a facet that carve its two cells
    TraceOptions trace;               ///< weights of rays
    CutOptions cut;                   ///< the minimum cut
    HullOptions hull;                 ///< surface along the convex hull
    VirtualViewOptions virtual_views; ///< additional viewpoints
};

/// Thresholds of the rules that keep or drop faces of the boundary. The terms are defined in
/// src/steps/6_surface/face_rules.h.
struct FaceRules {
    static constexpr double kAutoClosing = -1.0; ///< 0.115, or 0.02 with DenseOptions::dense

    /// Edge length of a long face, as a fraction of the diameter of the region of interest. Higher
    /// keeps more large faces; 0 keeps all visible faces, and trims none.
    double max_closing = kAutoClosing;
    /// Length from which visible bent rim faces drop, in `max_closing`; higher keeps more.
    double rim_closing = 2.0;
    /// Minimum visible fraction of long faces that bend away; higher drops more; 0 disables.
    double half_seen = 0.5;
    /// Minimum visible fraction of long faces and rim faces; higher drops more; 0 disables.
    double hardly_seen = 0.12;
    /// Edge length from which faces are trimmed, in `max_closing`; higher trims less; 0 disables.
    double trim = 0.5;
    /// Longest unseen faces kept beside kept ones, in local edges; higher keeps more; 0 disables.
    double beside_edge = 3.0;
    double beside_length = 8.0; ///< their maximum edge in longest edges of the median kept face
};

/// Cleanup of the mesh.
struct CleanupOptions {
    int min_component = 6; ///< minimum number of faces of a connected component (half if closed and
                           ///< without long faces); higher removes more; 0 disables
    int max_hole = 12;     ///< maximum number of edges of filled holes, up to 1000, since N edges
                           ///< take 16 N^2 bytes and N^3 steps; higher fills more; 0 disables
};

/// Selection of faces, and cleanup.
struct SurfaceOptions {
    bool closed = false;    ///< keep unseen faces, for a watertight mesh
    FaceRules rules;        ///< thresholds for dropping faces
    CleanupOptions cleanup; ///< components and holes
};

/// Smoothing of the mesh. A move that would occlude an observed point is rejected.
struct SmoothOptions {
    int iterations = 0; ///< number of iterations; higher is smoother; 0 disables
};

/// Simplification of the mesh.
struct SimplifyOptions {
    static constexpr int kAutoFaces = -1; ///< simplify dense surfaces within their noise

    int faces = kAutoFaces; ///< target number of faces; higher keeps more; 0 disables. With a
                            ///< number, a merge that would occlude an observed point is rejected.
};

/// Refinement of the mesh.
struct RefineOptions {
    SmoothOptions smooth;     ///< smoothing, by default off
    SimplifyOptions simplify; ///< simplification, by default of dense surfaces only
};

/// Memory limits.
struct MemoryOptions {
    static constexpr std::int64_t kAutoMemory = -1; ///< 80 % of the free memory

    std::int64_t limit = kAutoMemory; ///< maximum memory in bytes; 0 disables
};

/// All options of a run, one struct per step.
struct Options {
    /// Folder of the photographs, for dense points, texture and colors. If empty, dense points and
    /// texture use the folder `images` beside the model, and other runs no photographs.
    std::filesystem::path images;
    DenseOptions dense;             ///< dense points
    MaskOptions masks;              ///< masks of the photographs
    TextureOptions texture;         ///< texture
    FilterOptions points;           ///< filter for input points
    AddedPointOptions added_points; ///< points added on planes
    ThinOptions thin;               ///< merging of dense points
    CropOptions crop;               ///< region to reconstruct
    DenoiseOptions denoise;         ///< denoising of points or vertices
    LabelOptions labels;            ///< labeling of cells
    SurfaceOptions surface;         ///< selection of faces, and cleanup
    RefineOptions refine;           ///< smoothing and simplification
    int threads = 0;                ///< number of threads; 0 uses all. The mesh is the same for any
    MemoryOptions memory;           ///< memory limits
};

} // namespace vcarve
