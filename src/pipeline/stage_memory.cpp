#include "pipeline/stage_memory.h"

#include "model/tet_mesh.h"
#include "steps/1_points/thin.h"
#include "steps/3_cells/triangulate.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <algorithm>
#include <cstdint>

namespace vcarve {

namespace {

/// Scene: position, colour, error, id and begin of the track; a normal, where there are any; index
/// of a view; a view with its name.
constexpr double kScenePoint = 24 + 3 + 8 + 8 + 8;
constexpr double kSceneNormal = 12;
constexpr double kSceneSight = 4;
constexpr double kSceneView = 256;

/// CGAL: a cell holds 4 vertices, 4 neighbours, its state and index; a vertex its point, a cell and
/// its index; both with some room to grow.
constexpr double kCgalCell = 73;
constexpr double kCgalVertex = 48;
/// TetMesh.
constexpr double kFlatCell = sizeof(Cell) + 1;
constexpr double kFlatVertex = 24 + 4;

/// FlowNetwork, and the solver on top of it: its nodes or the facets' costs, and lists of cells.
constexpr double kNetworkCell = 16 + 4;
constexpr double kSolverCell = 16 + 8;

/// Points that are merged: their footprints, leaders and cubes, or the members of clusters, and the
/// rows of views that become united ones.
double merging(const Sizes& n)
{
    constexpr double kMerged = 70;
    return n.scene() + kMerged * n.points + kSceneSight * n.sights;
}

/// The points that are left of the parts before, one part, and what is left of it; or what is left
/// of all parts, which is merged once more, and what is left then.
double merging_parts(const Needs& needs)
{
    constexpr double kLeftOfParts = 1.25; // over what is left in the end
    const double before = kLeftOfParts * needs.left.scene();
    Sizes part = needs.read;
    part.points = std::min(part.points, static_cast<double>(kThinnedAtOnce));
    part.sights *= part.points / std::max(needs.read.points, 1.0);
    return std::max(before + merging(part) + std::min(part.scene(), before),
                    kLeftOfParts * merging(needs.left) + needs.left.scene());
}

} // namespace

double cgal(const Sizes& n)
{
    return n.cells() * kCgalCell + n.points * kCgalVertex;
}

double Sizes::scene() const
{
    return points * point_bytes + sights * kSceneSight + views * kSceneView;
}

double Sizes::after_triangulation() const
{
    return scene() + cells() * kFlatCell + points * kFlatVertex;
}

Sizes sizes_of(const SceneSize& size)
{
    return {.points = static_cast<double>(size.points),
            .sights = static_cast<double>(size.sights),
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
            .in_parts = size.in_parts};
}

/// The points around each point, 24 of them at most, normals, variances, and places before and
/// after.
double denoising(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kAround = 24 * 4 + 8;
    constexpr double kPlaced = 5 * 24 + 2 * 8;
    return n.scene() + n.points * (kAround + kPlaced);
}

/// The scene that was read, and the parts of it.
double thinning(const Needs& needs)
{
    return needs.read.scene() + merging_parts(needs);
}

/// The scene, and its positions once more, where the arrays of a text model grow; a binary one
/// needs a third of that, for its ids. Files are given back as they are read. Of a cloud that is
/// merged meanwhile, its parts.
double reading(const Needs& needs)
{
    if (needs.in_parts) return merging_parts(needs);
    const Sizes& n = needs.read;
    return n.scene() + 24 * n.points;
}

/// The scene, whose arrays are replaced one by one, and positions with what they are sorted by;
/// and what the allocator keeps of arrays that were freed, of models below a million points.
double filtering(const Needs& needs)
{
    const Sizes& n = needs.left;
    return n.scene() + (36 + 16) * n.points;
}

/// A k-d tree, the points around each point, what they tell, and those of flat parts once more.
double finding_planes(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kTree = 40 + 13;
    constexpr double kAround = 12 * 4 + 3 * 8;
    constexpr double kOfRegion = 2 * 4 + 2 * 24 + 13;
    constexpr double kCandidates = 300; ///< near a point, with surfaces
    return n.scene() + n.points * (kTree + kAround + kOfRegion + kCandidates);
}

/// CGAL's triangulation of the blocks in work, with the points they take in, their cells twice, as
/// these are numbered, and the cells of the other blocks; then, as they are joined, all cells
/// twice.
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
    const double triangulated = at_work * kTakenIn * cgal(n) + (1.0 + at_work) * cells;
    return n.scene() + std::max(triangulated, 2.0 * cells);
}

/// First the edges that the distance sigma is measured by, up to six a cell of a choice of cells,
/// in lists that grow; then the network, and the sights that each thread walks, those of 512
/// points.
double tracing(const Needs& needs)
{
    const Sizes& n = needs.left;
    const double edges = 6 * std::min(n.cells(), 5e4);
    const double walked =
        std::min(n.sights, needs.threads * 512 * n.sights / std::max(n.points, 1.0));
    constexpr double kSight = 96;
    constexpr double kInferred = 20; // of a cloud, about as many as there are; and what they say
    const double inferred = needs.is_dense ? kInferred * n.sights + kNetworkCell * n.cells() : 0.0;
    return n.after_triangulation() +
           std::max(24 * edges, n.cells() * kNetworkCell + kSight * walked + inferred);
}

/// The network, the solver, and the labels.
double cutting(const Needs& needs)
{
    const Sizes& n = needs.left;
    return n.after_triangulation() + n.cells() * (kNetworkCell + kSolverCell + 2);
}

/// What is counted of each facet, and the labels.
double carving(const Needs& needs)
{
    constexpr double kCell = 16 + 1;
    return needs.left.after_triangulation() + needs.left.cells() * kCell;
}

/// The labels and the surface, with the faces around each vertex, the usual edge there, and the
/// faces to keep; with what parallel loops collect twice.
double extracting(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 80 + 60; // its evidence
    constexpr double kVertex = 31 + 4 + 8;
    return n.after_triangulation() + n.cells() + n.faces() * kFace + n.points * kVertex;
}

/// The surface with its edges and seams; then with its seams the half-edges and what these are laid
/// by (146 bytes a face in all). The cells are gone by then.
double cleaning(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 165;
    return n.scene() + n.faces() * kFace;
}

/// The half-edges, and of each vertex what refine.h says.
double settling(const Needs& needs)
{
    const Sizes& n = needs.left;
    constexpr double kFace = 80;
    constexpr double kVertex = 250;
    return n.scene() + n.faces() * kFace + n.points * kVertex;
}

double sums_of_sights(const Sizes& n)
{
    return kNetworkCell * n.cells();
}

} // namespace vcarve
