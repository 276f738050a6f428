#include "pipeline/memory.h"

#include "base/byte_size.h"
#include "model/tet_mesh.h"
#include "steps/1_points/thin.h"
#include "steps/3_cells/triangulate.h"
#include "vcarve/error.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// Code, libraries and small things; the stack of a thread, and what allocators keep for it.
constexpr double kProgram = 11.5e6;
constexpr double kThread = 0.5e6;

constexpr double kCellsPerPoint = 6.8;
constexpr double kFacesPerPoint = 2.0; ///< of a closed surface through all points

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

/// Counts of a model, as doubles: products of them leave no range.
struct Sizes {
    double points;
    double sights;
    double views;
    double cells;
    double faces;
    double threads;
    double point_bytes; ///< of the scene

    double scene() const
    {
        return points * point_bytes + sights * kSceneSight + views * kSceneView;
    }
    double cgal() const { return cells * kCgalCell + points * kCgalVertex; }
    double flat() const { return cells * kFlatCell + points * kFlatVertex; }

    double after_triangulation() const { return scene() + flat(); }
};

/// Points that are merged: their footprints, leaders and cubes, or the members of clusters, and the
/// rows of views that become united ones.
double merging(const Sizes& points)
{
    constexpr double kMerged = 70;
    return points.scene() + kMerged * points.points + kSceneSight * points.sights;
}

/// The points that are left of the parts before, one part, and what is left of it; or what is left
/// of all parts, which is merged once more, and what is left then.
double thinning(const Sizes& read, const Sizes& thinned)
{
    constexpr double kLeftOfParts = 1.25; // over what is left in the end
    const double before = kLeftOfParts * thinned.scene();
    Sizes part = read;
    part.points = std::min(read.points, static_cast<double>(kThinnedAtOnce));
    part.sights *= part.points / std::max(read.points, 1.0);
    return std::max(before + merging(part) + std::min(part.scene(), before),
                    kLeftOfParts * merging(thinned) + thinned.scene());
}

/// The points around each point, 24 of them at most, normals, variances, and places before and
/// after.
double denoising(const Sizes& n)
{
    constexpr double kAround = 24 * 4 + 8;
    constexpr double kPlaced = 5 * 24 + 2 * 8;
    return n.scene() + n.points * (kAround + kPlaced);
}

/// The scene, and its positions once more, where the arrays of a text model grow; a binary one
/// needs a third of that, for its ids. Files are given back as they are read.
double reading(const Sizes& n)
{
    return n.scene() + 24 * n.points;
}

/// The scene, whose arrays are replaced one by one, and positions with what they are sorted by;
/// and what the allocator keeps of arrays that were freed, of models below a million points.
double filtering(const Sizes& n)
{
    return n.scene() + (36 + 16) * n.points;
}

/// A k-d tree, the points around each point, what they tell, and those of flat parts once more.
double finding_creases(const Sizes& n)
{
    constexpr double kTree = 40 + 13;
    constexpr double kAround = 12 * 4 + 3 * 8;
    constexpr double kOfRegion = 2 * 4 + 24;
    return n.scene() + n.points * (kTree + kAround + kOfRegion);
}

/// CGAL's triangulation of the blocks in work, with the points they take in, their cells twice, as
/// these are numbered, and the cells of the other blocks; then, as they are joined, all cells
/// twice.
double triangulating(const Sizes& n)
{
    constexpr double kTakenIn = 1.1;
    const auto points = static_cast<std::size_t>(std::min(n.points, 0x1p62));
    const auto threads = static_cast<std::size_t>(n.threads);
    const auto blocks = static_cast<double>(usual_blocks(points, threads));
    const double cells = sizeof(Cell) * n.cells;
    if (blocks == 1.0) return n.scene() + n.cgal() + cells;
    const double at_work = std::min(n.threads / blocks, 1.0);
    const double triangulated = at_work * kTakenIn * n.cgal() + (1.0 + at_work) * cells;
    return n.scene() + std::max(triangulated, 2.0 * cells);
}

/// First the edges that the distance sigma is measured by, up to six a cell of a choice of cells,
/// in lists that grow; then the network, and the sights that each thread walks, those of 512
/// points.
double tracing(const Sizes& n)
{
    const double edges = 6 * std::min(n.cells, 5e4);
    const double walked = std::min(n.sights, n.threads * 512 * n.sights / std::max(n.points, 1.0));
    constexpr double kSight = 96;
    return n.after_triangulation() + std::max(24 * edges, n.cells * kNetworkCell + kSight * walked);
}

/// The network, the solver, and the labels.
double cutting(const Sizes& n)
{
    return n.after_triangulation() + n.cells * (kNetworkCell + kSolverCell + 2);
}

/// The labels and the surface, with the faces around each vertex, the usual edge there, and the
/// faces to keep; with what parallel loops collect twice.
double extracting(const Sizes& n)
{
    constexpr double kFace = 80;
    constexpr double kVertex = 31 + 4 + 8;
    return n.after_triangulation() + n.cells + n.faces * kFace + n.points * kVertex;
}

/// The surface with its edges and seams; then with its seams the half-edges and what these are laid
/// by (146 bytes a face in all). The cells are gone by then.
double cleaning(const Sizes& n)
{
    constexpr double kFace = 150;
    return n.scene() + n.faces * kFace;
}

/// CGAL's triangulation of a block, with the ghosts around it, a point of the block.
constexpr double kBlockPoint = 600;
/// What a run in blocks has in the heap, a point: arrays that are too small for files of their own
/// (22 bytes were measured of 5 M points).
constexpr double kHeapPoint = 24;
/// The same while creases are looked for: the nodes of the k-d tree, and the points of regions.
constexpr double kHeapCreasePoint = 42;
/// Files in the work folder against what passes are predicted to need: arrays that grow stand
/// twice.
constexpr double kScratchMargin = 1.1;

Sizes sizes(const SceneSize& size, int threads)
{
    const auto points = static_cast<double>(size.points);
    return {.points = points,
            .sights = static_cast<double>(size.sights),
            .views = static_cast<double>(size.views),
            .cells = kCellsPerPoint * points,
            .faces = kFacesPerPoint * points,
            .threads = static_cast<double>(threads),
            .point_bytes = kScenePoint + (size.has_normals ? kSceneNormal : 0.0)};
}

[[noreturn]] void refuse_in_blocks(const RunSize& size, std::int64_t least, std::int64_t most)
{
    throw InputError(fmt::format("{} points with {} sights need about {} of memory even in blocks, "
                                 "and --max-memory allows {}",
                                 size.read.points, size.read.sights, byte_size_text(least),
                                 byte_size_text(most)));
}

} // namespace

RunSize size_before_thinning(const SceneSize& read, const ThinOptions& options)
{
    const bool is_thinned = read.is_dense && options.merge_px > 0.0;
    return {.read = read, .thinned = is_thinned ? SceneSize{} : read, .in_parts = is_thinned};
}

std::vector<StageMemory> predicted_memory(const RunSize& size, int threads)
{
    const Sizes all = sizes(size.read, threads);
    const Sizes n = sizes(size.thinned, threads);
    std::vector<StageMemory> stages;
    const auto add = [&](const char* name, double bytes) {
        const double program = kProgram + kThread * n.threads;
        stages.push_back({name, std::llround(std::min(program + bytes, 0x1p62))});
    };
    add("read", size.in_parts ? thinning(all, n) : reading(all));
    if (size.read.is_dense && !size.in_parts) add("thin", all.scene() + thinning(all, n));
    add("filter", filtering(n));
    if (size.read.is_dense) add("denoise", denoising(n));
    if (!size.read.is_dense) add("creases", finding_creases(n));
    add("triangulate", triangulating(n));
    add("sights", tracing(n));
    add("cut", cutting(n));
    add("surface", extracting(n));
    add("clean", cleaning(n));
    return stages;
}

std::int64_t predicted_peak(const RunSize& size, int threads)
{
    const std::vector<StageMemory> stages = predicted_memory(size, threads);
    return std::ranges::max(stages, {}, &StageMemory::bytes).bytes;
}

void require_memory(const RunSize& size, int threads, std::int64_t most)
{
    const std::int64_t needed = predicted_peak(size, threads);
    if (most <= 0 || needed <= most) return;
    throw InputError(fmt::format("{} points with {} sights need about {} of memory, and "
                                 "--max-memory allows {}",
                                 size.read.points, size.read.sights, byte_size_text(needed),
                                 byte_size_text(most)));
}

std::int64_t predicted_scratch(const RunSize& size)
{
    Sizes all = sizes(size.read, 1);
    Sizes n = sizes(size.thinned, 1);
    const double read = size.in_parts ? thinning(all, n) : reading(all);
    const double of_cells = std::max(cutting(n), extracting(n));
    const double most = std::max({read, filtering(n), denoising(n), of_cells, cleaning(n)});
    return std::llround(std::min(kScratchMargin * most, 0x1p62));
}

std::int64_t predicted_share(const RunSize& size)
{
    // The sums of all cells, and those that are not zero once more.
    const double sums = 2 * kNetworkCell * sizes(size.thinned, 1).cells;
    return std::llround(std::min(sums, 0x1p62));
}

std::int64_t least_memory(const RunSize& size, int threads)
{
    const Sizes n = sizes(size.thinned, threads);
    const double point = kHeapPoint + (size.read.is_dense ? 0.0 : kHeapCreasePoint);
    return std::llround(std::min(kProgram + kThread * n.threads + point * n.points, 0x1p62));
}

BlockPlan plan_blocks(const RunSize& size, int threads, const MemoryOptions& wanted,
                      std::optional<std::int64_t> free)
{
    const bool is_open = wanted.most == MemoryOptions::kAutoMemory;
    BlockPlan plan;
    plan.needed = predicted_peak(size, threads);
    plan.most = is_open ? free.value_or(0) / 5 * 4 : wanted.most;
    if (wanted.blocks == 0) {
        require_memory(size, threads, wanted.most);
        return plan;
    }
    const bool fits = plan.most == 0 || plan.needed <= plan.most;
    if (wanted.blocks == MemoryOptions::kAutoBlocks && fits) return plan;

    const std::int64_t least = least_memory(size, threads);
    if (plan.most > 0 && least >= plan.most) refuse_in_blocks(size, least, plan.most);
    plan.scratch = predicted_scratch(size);
    plan.blocks = wanted.blocks;
    if (wanted.blocks == MemoryOptions::kAutoBlocks) {
        const double at_once = kBlockPoint * static_cast<double>(size.thinned.points) * threads;
        const double blocks = std::ceil(at_once / (0.5 * static_cast<double>(plan.most - least)));
        plan.blocks = static_cast<int>(std::clamp(blocks, 2.0, 65536.0));
    }
    return plan;
}

} // namespace vcarve
