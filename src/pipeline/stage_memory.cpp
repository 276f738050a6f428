#include "pipeline/stage_memory.h"

#include "model/tet_mesh.h"
#include "photo_refine/refine_mesh.h"
#include "steps/1_points/thin.h"
#include "steps/3_cells/triangulate.h"
#include "stereo/dense_points.h"
#include "texture/texture_mesh.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace vcarve {

namespace {

/// Bytes of the scene. Point: position, color, error, id and begin of the track; normal, if any.
/// Ray: index of a view. View: with its name.
constexpr double kScenePoint = 24 + 3 + 8 + 8 + 8;
constexpr double kSceneNormal = 12;
constexpr double kSceneRay = 4;
constexpr double kSceneView = 256;

/// Bytes in CGAL. A cell has 4 vertices, 4 neighbors, state and index; a vertex has a point, a cell
/// and an index. Both include room to grow.
constexpr double kCgalCell = 73;
constexpr double kCgalVertex = 48;
/// Bytes in a TetMesh.
constexpr double kFlatCell = sizeof(Cell) + 1;
constexpr double kFlatVertex = 24 + 4;

/// Bytes per cell of FlowNetwork, and of the solver: nodes or facet costs, and lists of cells.
constexpr double kNetworkCell = 16 + 4;
constexpr double kSolverCell = 16 + 8;

/// Merging points: footprints, leaders and cubes, or members of clusters, and the views of merged
/// points.
double merging(const Sizes& n)
{
    constexpr double kMerged = 70;
    return n.scene() + kMerged * n.points + kSceneRay * n.rays;
}

/// Merging in parts: the merged points of earlier parts, one part, and its merged points; or the
/// merged points of all parts while they are merged once more, and the result.
double merging_parts(const Needs& needs)
{
    constexpr double kLeftOfParts = 1.25; // ratio to the final result
    const double before = kLeftOfParts * needs.left.scene();
    Sizes part = needs.read;
    part.points = std::min(part.points, static_cast<double>(kThinnedAtOnce));
    part.rays *= part.points / std::max(needs.read.points, 1.0);
    return std::max(before + merging(part) + std::min(part.scene(), before),
                    kLeftOfParts * merging(needs.left) + needs.left.scene());
}

/// Pixels of all photographs, and of the largest.
std::pair<double, double> pixels_of(const std::vector<PhotographSize>& photos)
{
    double all = 0.0;
    double largest = 0.0;
    for (const PhotographSize& photo : photos) {
        const double pixels = static_cast<double>(photo.width_px) * photo.height_px;
        all += pixels;
        largest = std::max(largest, pixels);
    }
    return {all, largest};
}

/// The scene, the mesh with vertices, normals and colors, and `face` bytes per face.
double mesh_with(const Sizes& n, double face)
{
    constexpr double kMeshFace = 12 + 39 / 2.0;
    return n.scene() + n.faces() * (kMeshFace + face);
}

constexpr double kTreeFace = 150; ///< of FirstFaces

/// CGAL's triangulation of all points.
double cgal(const Sizes& n)
{
    return n.cells() * kCgalCell + n.points * kCgalVertex;
}

} // namespace

double Sizes::scene() const
{
    return points * point_bytes + rays * kSceneRay + views * kSceneView;
}

double Sizes::after_triangulation() const
{
    return scene() + cells() * kFlatCell + points * kFlatVertex;
}

Sizes sizes_of(const SceneSize& size)
{
    return {.points = static_cast<double>(size.points),
            .rays = static_cast<double>(size.rays),
            .views = static_cast<double>(size.views),
            .point_bytes = kScenePoint + (size.has_normals ? kSceneNormal : 0.0)};
}

Needs needs_of(const RunSize& size, int threads)
{
    return {.options = size.options,
            .read = sizes_of(size.read),
            .left = sizes_of(size.thinned),
            .threads = static_cast<double>(threads),
            .is_dense = size.read.is_dense,
            .in_parts = size.in_parts,
            .is_tile = size.is_tile,
            .photos = size.photos,
            .measures_dense = size.measures_dense,
            .has_report = size.has_report};
}

/// At most 24 neighbors of each point, normals, variances, and positions before and after.
double denoising(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kAround = 24 * 4 + 8;
    constexpr double kPlaced = 5 * 24 + 2 * 8;
    return n.scene() + n.points * (kAround + kPlaced);
}

/// The input scene, and its parts.
double thinning(const Needs& needs)
{
    return needs.read.scene() + merging_parts(needs);
}

/// The scene, and a copy of its positions while the arrays of a text model grow. A binary model
/// needs a third of the copy, for its ids. File pages are released as they are read. If a cloud is
/// merged while it is read, its parts.
double reading(const Needs& needs)
{
    if (needs.in_parts) return merging_parts(needs);
    const Sizes& n = needs.read;
    return n.scene() + 24 * n.points;
}

/// The scene, whose arrays are replaced one by one, and positions with sort keys. For models below
/// a million points, also freed arrays that the allocator retains.
double filtering(const Needs& needs)
{
    const Sizes& n = needs.left;
    return n.scene() + (36 + 16) * n.points;
}

/// A k-d tree, the neighbors, direction, spacing and flatness of each point, and the points of
/// regions.
double finding_planes(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kTree = 40 + 13;
    constexpr double kAround = 12 * 4 + 12 + 6 * 8;
    constexpr double kOfRegion = 2 * 4 + 2 * 24 + 13;
    constexpr double kCandidates = 300; ///< candidates near a point, and surfaces
    return n.scene() + n.points * (kTree + kAround + kOfRegion + kCandidates);
}

/// First CGAL's triangulation of the current blocks with the points around them, and the cells of
/// all blocks. Then two copies of all cells while blocks are numbered and joined.
double triangulating(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kTakenIn = 1.1;
    const auto points = static_cast<std::size_t>(std::min(n.points, 0x1p62));
    const auto threads = static_cast<std::size_t>(needs.threads);
    const auto blocks = static_cast<double>(usual_blocks(points, threads));
    const double cells = sizeof(Cell) * n.cells();
    if (blocks == 1.0) return n.scene() + cgal(n) + cells;
    const double at_work = std::min(needs.threads / blocks, 1.0);
    const double triangulated = at_work * kTakenIn * cgal(n) + cells;
    return n.scene() + std::max(triangulated, 2.0 * cells);
}

/// First the edges that determine the distance sigma: up to six per sampled cell, in growing lists.
/// Then the network, and the current rays of each thread, which are those of 512 points.
double tracing(const Needs& needs)
{
    const Sizes& n = needs.left;
    const double edges = 6 * std::min(n.cells(), 5e4);
    const double walked = std::min(n.rays, needs.threads * 512 * n.rays / std::max(n.points, 1.0));
    constexpr double kRay = 96;
    constexpr double kInferred = 20; // per ray of a cloud: about one inferred ray
    const double inferred = needs.is_dense ? kInferred * n.rays : 0.0;
    return n.after_triangulation() +
           std::max(24 * edges, n.cells() * kNetworkCell + kRay * walked + inferred);
}

/// The network, the solver, and the labels.
double cutting(const Needs& needs)
{
    const Sizes& n = needs.left;
    return n.after_triangulation() + n.cells() * (kNetworkCell + kSolverCell + 2);
}

/// The crossing counts of all facets, and the labels.
double carving(const Needs& needs)
{
    constexpr double kCell = 16 + 1;
    return needs.left.after_triangulation() + needs.left.cells() * kCell;
}

/// The labels and the surface, with the faces around each vertex, its usual edge length, and the
/// faces to keep. Results of parallel loops count twice.
double extracting(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 80 + 60; // its FaceEvidence
    constexpr double kVertex = 31 + 4 + 8;
    return n.after_triangulation() + n.cells() + n.faces() * kFace + n.points * kVertex;
}

/// The surface with its edges and seams; then seams, half-edges and the tables to build them (146
/// bytes per face in total). The cells are already freed.
double cleaning(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 165;
    return n.scene() + n.faces() * kFace;
}

/// The half-edges, and the data per vertex that refine.h lists.
double adjusting(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 80;
    constexpr double kVertex = 250;
    return n.scene() + n.faces() * kFace + n.points * kVertex;
}

/// The sparse surface with the tree of its faces, the working images and the depth maps.
double measuring_depth(const Needs& needs)
{
    return mesh_with(needs.left, kTreeFace) +
           stereo_bytes(needs.photos, needs.options.dense, needs.threads);
}

/// A tree, the votes of the faces, and one mask per thread; or the half-edges of the kept faces.
double masking(const Needs& needs)
{
    constexpr double kHalfEdges = 165;
    const double masks = 3.0 * needs.threads * pixels_of(needs.photos).second;
    return mesh_with(needs.left, std::max(kTreeFace + 8, kHalfEdges)) + masks;
}

/// The refined mesh, about ten times as large, with its curves; and the photographs at their size
/// with their depths.
double refining(const Needs& needs)
{
    constexpr double kVertex = 24 + 2 * 12 + 84 + 12 + 7 * 12 + 5 * 8;
    constexpr double kTimesLarger = 10.0;
    return needs.left.scene() + kTimesLarger * needs.left.points * kVertex +
           refine_bytes(needs.photos, needs.options.dense.refine_px, needs.threads);
}

/// A tree, and the photographs of the faces.
double finding_photos(const Needs& needs)
{
    return mesh_with(needs.left, kTreeFace + sizeof(PhotosOfFace));
}

/// The photographs and colors of the faces, and the photographs in memory with their pyramids.
double coloring(const Needs& needs)
{
    constexpr double kFace = sizeof(PhotosOfFace) + sizeof(FaceColors::value_type);
    const TextureLimits limits = texture_limits(needs.options, needs.photos);
    const double at_a_time = std::min(static_cast<double>(limits.photos_at_a_time), needs.threads);
    return mesh_with(needs.left, kFace) +
           at_a_time * kPhotoPixelBytes * pixels_of(needs.photos).second;
}

/// The same, and the pages: about a quarter of all pixels, because most faces are in several
/// photographs (measured: 0.07 to 0.26).
double painting(const Needs& needs)
{
    constexpr double kTexelsOfPixel = 0.3;
    const TextureLimits limits = texture_limits(needs.options, needs.photos);
    const double scale_sq = limits.scale * limits.scale;
    return coloring(needs) +
           kTexelBytes * std::min(static_cast<double>(limits.most_texels),
                                  kTexelsOfPixel * scale_sq * pixels_of(needs.photos).first);
}

/// The mesh and the scene as numbers and as text of the page.
double reporting(const Needs& needs)
{
    constexpr double kFace = 120;
    return 2.0 * mesh_with(needs.left, kFace);
}

} // namespace vcarve
