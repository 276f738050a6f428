#pragma once

#include "vcarve/log.h"

/// The kinds of counts, in groups of stages. Stages report them in this order.
namespace vcarve::counts {

inline constexpr struct Plan { // digest, memory, plan, wait
    CountKind files = {"files", "{} input files", "files on which the mesh depends"};
    CountKind memory = {"MiB expected", "{} MiB expected", "predicted peak of the memory"};
    CountKind tiles = {"tiles", "{} tiles", "tiles of the model"};
    CountKind points = {"points", " ({} points)", "points of the model"};
} kPlan;
inline constexpr struct Read {
    CountKind points = {"points", "{} points", "points of the model, or of a sample of them"};
    CountKind views = {"views", ", {} views", "images with a pose, and scanners", true};
    CountKind rays = {"rays", ", {} rays", "pairs of a point and a view that sees it", true};
} kRead;
inline constexpr struct Dense { // undistort, depth, fuse
    CountKind photos = {"photographs", "{} photographs undistorted", "readable photographs"};
    CountKind maps = {"depth maps", "{} depth maps", "photographs with a depth map"};
    CountKind measured = {"pixels measured", "", "pixels of depth maps with a depth"};
    CountKind points = {"points", "{} points fused", "dense points"};
    CountKind fused = {"pixels fused", "", "pixels that are part of a dense point"};
} kDense;
inline constexpr struct Merge { // merge, decimate, simplify
    CountKind points = {"points", "{of} points merged to {}", "points left"};
    CountKind faces = {"faces", "{of} faces merged to {}", "faces left"};
    CountKind components = {"components dropped", "", "small components"};
} kMerge;
inline constexpr struct PhotoRefine {
    CountKind vertices = {"vertices", "{of} vertices, {} measured by photographs",
                          "vertices measured by photographs"};
} kPhotoRefine;
inline constexpr struct Filter {
    CountKind points = {"points", "{} of {of} points kept", "points left"};
    CountKind duplicate = {"duplicate", ", {} duplicate", "points at the place of another"};
    CountKind few_views = {"few views", ", {} few views", "points dropped by --min-views"};
    CountKind high_error = {"high error", ", {} large error", "points dropped by --max-error"};
    CountKind low_angle = {"low angle", ", {} small angle", "points dropped by --min-angle"};
    CountKind stray = {"stray", ", {} stray", "points dropped by --stray-spacing"};
    CountKind non_finite = {"non-finite", ", {} not finite", "points without a finite position"};
} kFilter;
inline constexpr struct Points { // fill, crop
    CountKind added = {"points added", "{} points added on planes", "points added"};
    CountKind regions = {"planar regions", "", "regions of planes"};
    CountKind inside = {"points", "{} of {of} points in the region", "points in the region"};
    CountKind witnesses = {"outside but seen through it", ", {} seen through it",
                           "points kept for their rays"};
} kPoints;
inline constexpr struct Denoise { // denoise, adjust
    CountKind points = {"points moved", "{} points moved within their error", "points moved"};
    CountKind vertices = {"vertices moved", "{} vertices moved within their error",
                          "vertices moved"};
    CountKind held = {"held back", "", "vertices that stay because a face would fold"};
    CountKind noise = {"thousandths of a pixel of noise", " ({milli} px)", "the measured noise"};
} kDenoise;
inline constexpr struct Cells { // triangulate, rays, cut, carve
    CountKind all = {"cells", "{} cells", "cells of the triangulation"};
    CountKind rays = {"rays", "{} rays from points to cameras", "rays that were traced"};
    CountKind inferred = {"inferred", " ({} inferred)", "further rays that the file lacks"};
    CountKind inside = {"inside", "{} of {of} cells are solid", "cells labeled inside"};
    CountKind on_hull = {"faces of the hull", "", "faces of inside cells on the hull"};
} kCells;
inline constexpr struct Viewpoints {
    CountKind views = {"views", "{} viewpoints added", "virtual viewpoints"};
    CountKind rays = {"rays", ", {} rays", "rays from points to them", true};
} kViewpoints;
inline constexpr struct Surface {
    CountKind faces = {"faces", "{} visible faces", "faces kept"};
    CountKind unseen = {"unseen", ", {} unseen dropped", "faces that no view sees"};
    CountKind unsupported = {"unsupported", ", {} unsupported dropped",
                             "dropped faces across gaps"};
    CountKind trimmed = {"trimmed", "", "faces that lost a part"};
    CountKind outside = {"outside the region", "", "faces outside the region"};
} kSurface;
inline constexpr struct Mesh { // clean, open, orient
    CountKind vertices = {"vertices", "", "vertices left"};
    CountKind faces = {"faces", "{} faces", "faces left"};
    CountKind split_edges = {"split edges", "", "edges with more than two faces"};
    CountKind split_vertices = {"split vertices", "", "vertices with several fans of faces"};
    CountKind holes = {"holes filled", ", holes filled: {}", "holes of at most --max-hole edges"};
    CountKind components = {"components dropped", ", components dropped: {}", "small components"};
    CountKind open = {"rays of the views", "", "rays of pixels that pass through holes"};
    CountKind past = {"past", "", "rays of pixels that meet no surface"};
    CountKind outside = {"rays on the outside", "", "rays that meet the surface from the front"};
    CountKind boundary_edges = {"boundary edges", "", "edges with one face"};
} kMesh;
inline constexpr struct Smooth { // guard, smooth
    CountKind rays = {"rays", "", "rays that no vertex may block when it moves"};
    CountKind moved = {"vertices moved", "{} of {of} vertices moved", "vertices moved"};
    CountKind held = {"held by rays", "", "vertices that stay because they would block a ray"};
} kSmooth;
inline constexpr struct Texture { // masks, photos, colors, texture
    CountKind masks = {"masks", "", "views with a mask"};
    CountKind unmasked = {"faces", "{} of {of} faces outside the masks", "faces left"};
    CountKind seen = {"seen", "{} of {of} faces shown", "faces shown by a photograph"};
    CountKind photos = {"photographs", " by {} photographs", "photographs found", true};
    CountKind vertices = {"vertices", "{} vertices colored", "vertices with a color"};
    CountKind outliers = {"outliers", ", {} occluded views ignored", "colors unlike the others"};
    CountKind charts = {"charts", "{} charts", "charts of the texture"};
    CountKind pages = {"pages", " on {} pages", "pictures of the texture", true};
    CountKind bare = {"bare faces", "", "faces that no photograph shows"};
} kTexture;
inline constexpr struct Join {
    CountKind faces = {"faces", "{} faces", "faces left"};
    CountKind boundary_edges = {"boundary edges", ", {} boundary edges", "edges with one face"};
    CountKind seam_edges = {"seam edges", ", {} seam edges", "edges at which two tiles agree"};
    CountKind open = {"open", ", {} open", "edges of one tile because two tiles disagree"};
    CountKind holes = {"holes filled", ", {} holes filled", "holes at seams"};
    CountKind split = {"vertices split", ", {} vertices split", "vertices with several fans"};
} kJoin;
inline constexpr struct Output { // write, check, report, preview
    CountKind faces = {"faces", "", "faces written"};
    CountKind vertices = {"vertices", "", "vertices written"};
    CountKind open_edges = {"open edges", "{} boundary edges", "edges with one face"};
    CountKind crossing = {"self-intersections", ", {} intersecting faces",
                          "faces that intersect others"};
    CountKind behind = {"rays from behind", ", {} rays from behind",
                        "rays that meet the back of a face"};
    CountKind faces_shown = {"faces shown", "{} of {of} faces shown", "faces on the page"};
    CountKind surfaces = {"surfaces shown", "{} surfaces shown", "meshes on the page"};
    CountKind pixels = {"pixels", "{} pixels", "pixels that show the mesh"};
} kOutput;
inline constexpr struct Compare { // reference, closed, measure
    CountKind points = {"points", "{} points", "points of the model"};
    CountKind samples = {"samples of the truth", " ({} samples of the truth)",
                         "samples of the true surface"};
    CountKind closed = {"faces of the closed surface", "{} faces of the closed surface",
                        "faces without holes"};
    CountKind faces = {"faces", "{} faces", "faces of the measured mesh"};
} kCompare;
inline constexpr struct TileFiles { // points, surfaces
    CountKind made = {"tiles", "{} of {of} tiles", "tiles of which this process made the file"};
} kTileFiles;

} // namespace vcarve::counts
