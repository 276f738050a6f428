#include "steps/3_cells/block_cells.h"

#include "base/arrays.h"
#include "base/free_memory.h"
#include "geometry/predicates.h"
#include "steps/3_cells/delaunay.h"
#include "steps/3_cells/limits.h"
#include "steps/3_cells/sphere_bound.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using CellHandle = Triangulation::Cell_handle;
using VertexHandle = Triangulation::Vertex_handle;

/// The number of a cell whose sphere is known to be empty, while the block grows.
constexpr Index kEmptySphere = 0;

/// The maximum number of tested points per point of a block, usually some hundred. Exact tests take
/// a hundred times as long and have a lower limit.
constexpr std::size_t kLooks = 3000;
constexpr std::size_t kExactLooks = 60;
constexpr std::size_t kFreeLooks = 20'000; ///< added to the number of points

/// The corners of CGAL's facet i of a cell, such that orientation(corners, corner i) is positive if
/// the cell is not inverted.
constexpr std::array<std::array<int, 3>, 4> kBeforeCorner = {
    {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};

/// The shares of the time at the end of three phases: inserting own points, testing all spheres,
/// inserting points of other blocks. The rest orders the cells.
constexpr double kOwn = 0.6;
constexpr double kFirstLook = 0.8;
constexpr double kForeign = 0.95;

/// The triangulation of a block's points and the points of other blocks that it needs.
class Block {
  public:
    Block(const PointTree& tree, const PointRun& own, CellCount& count)
        : tree_(tree), own_(own), count_(count), to_foreign_(tree.distances_to_others(own))
    {
        triangulation_.infinite_vertex()->info() = kInfinite;
    }

    void insert(Index point, VertexHandle near)
    {
        last_ = triangulation_.insert(to_cgal(tree_.points()[point]), near);
        last_->info() = point;
        ++inserted_;
        if (triangulation_.number_of_vertices() != inserted_) throw duplicate_position_error();
        count_.change(counted_, triangulation_.number_of_cells());
        counted_ = triangulation_.number_of_cells();
    }
    VertexHandle last_inserted() const { return last_; }

    const Triangulation& cells() const { return triangulation_; }
    void clear() { triangulation_.clear(); }

    bool is_own(VertexHandle vertex) const { return own_.contains(vertex->info()); }

    bool has_own_corner(CellHandle cell) const
    {
        return std::ranges::any_of(std::array{0, 1, 2, 3},
                                   [&](int i) { return is_own(cell->vertex(i)); });
    }

    /// The deepest point of other blocks in the sphere around a cell, up to rounding. For an
    /// infinite cell, the deepest point beyond its facet of the hull.
    std::optional<Index> deepest_foreign(CellHandle cell)
    {
        SphereBound bound = sphere_of(cell);
        if (is_far_from_foreign(cell, bound)) return std::nullopt;
        bound = bound.within(tree_.box());
        double least = 0.0;
        std::optional<Index> deepest;
        tree_.visit_excluding(
            own_, least, [&](const Box& box) { return bound.least_in(box); },
            [&](std::size_t i) {
                const double at = bound.least_at(tree_.points()[i]);
                const auto point = static_cast<Index>(i);
                count_look(looks_, kLooks);
                if (at > least) return;
                count_look(exact_looks_, kExactLooks);
                if (!is_inside(cell, point)) return;
                least = at;
                deepest = point;
            });
        return deepest;
    }

  private:
    void count_look(std::size_t& looks, std::size_t most) const
    {
        if (++looks > most * (own_.size() + kFreeLooks)) throw TooManyTies();
    }

    static Vector3d position(VertexHandle vertex)
    {
        const Kernel::Point_3& point = vertex->point();
        return {point.x(), point.y(), point.z()};
    }

    static SphereBound sphere_of(CellHandle cell)
    {
        for (int i = 0; i < 4; ++i) {
            if (cell->vertex(i)->info() != kInfinite) continue;
            const auto& [a, b, c] = kBeforeCorner[i];
            return SphereBound::beyond(
                {position(cell->vertex(a)), position(cell->vertex(b)), position(cell->vertex(c))});
        }
        return SphereBound::around({position(cell->vertex(0)), position(cell->vertex(1)),
                                    position(cell->vertex(2)), position(cell->vertex(3))});
    }

    /// Whether the distance of an own corner to points of other blocks already shows that the
    /// sphere contains none. This is true for most cells.
    bool is_far_from_foreign(CellHandle cell, const SphereBound& bound) const
    {
        double distance = 0.0;
        for (int i = 0; i < 4; ++i) {
            const VertexHandle vertex = cell->vertex(i);
            if (!is_own(vertex)) continue;
            const std::size_t leaf = vertex->info() / PointTree::kLeaf;
            distance = std::max(distance, to_foreign_[leaf - own_.first / PointTree::kLeaf]);
        }
        return bound.is_within(distance);
    }

    /// An exact test, which breaks ties like CGAL's insertion.
    bool is_inside(CellHandle cell, Index point) const
    {
        for (int i = 0; i < 4; ++i) {
            if (cell->vertex(i)->info() == point) return false;
        }
        return triangulation_.side_of_sphere(cell, to_cgal(tree_.points()[point]), true) ==
               CGAL::ON_BOUNDED_SIDE;
    }

    const PointTree& tree_;
    PointRun own_;
    CellCount& count_;
    std::size_t counted_ = 0;
    std::vector<double> to_foreign_; ///< per own leaf: distance to the nearest foreign point
    Triangulation triangulation_;
    VertexHandle last_;
    std::size_t inserted_ = 0;
    std::size_t looks_ = 0;
    std::size_t exact_looks_ = 0;
};

/// A point to insert, and a vertex of a cell whose sphere contains it.
struct Wanted {
    Index point;
    VertexHandle near;
};

/// Adds the deepest point in the sphere of a cell to `wanted`, if any.
void look_into(CellHandle cell, Block& block, std::vector<Wanted>& wanted)
{
    if (cell->info().value == kEmptySphere || !block.has_own_corner(cell)) return;
    if (const std::optional<Index> deepest = block.deepest_foreign(cell)) {
        const VertexHandle corner = cell->vertex(0);
        wanted.push_back({*deepest, corner->info() == kInfinite ? cell->vertex(1) : corner});
    } else {
        cell->info().value = kEmptySphere;
    }
}

std::vector<Wanted> points_in_spheres(Block& block, BlockProgress& progress)
{
    std::vector<Wanted> wanted;
    const auto all = static_cast<double>(block.cells().tds().cells().size());
    std::size_t count = 0;
    for (const CellHandle cell : block.cells().all_cell_handles()) {
        look_into(cell, block, wanted);
        if (++count % Progress::kReportEvery != 0) continue;
        progress.report(kOwn + (kFirstLook - kOwn) * static_cast<double>(count) / all);
    }
    return wanted;
}

/// The same for the cells around the points inserted last, which include all new cells.
std::vector<Wanted> points_in_spheres_around(const std::vector<VertexHandle>& inserted,
                                             Block& block)
{
    std::vector<Wanted> wanted;
    std::vector<CellHandle> around;
    for (const VertexHandle vertex : inserted) {
        around.clear();
        block.cells().incident_cells(vertex, std::back_inserter(around));
        for (const CellHandle cell : around)
            look_into(cell, block, wanted);
    }
    return wanted;
}

/// Inserts each wanted point once.
std::vector<VertexHandle> insert_wanted(std::vector<Wanted> wanted, Block& block)
{
    std::ranges::sort(wanted, {}, &Wanted::point);
    std::vector<VertexHandle> inserted;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (i > 0 && wanted[i].point == wanted[i - 1].point) continue;
        block.insert(wanted[i].point, wanted[i].near);
        inserted.push_back(block.last_inserted());
    }
    return inserted;
}

void insert_own(Block& block, const std::vector<Index>& first, const PointRun& own,
                BlockProgress& progress)
{
    for (const Index point : first)
        block.insert(point, block.last_inserted());
    const UnsetArray<std::uint32_t> order = insertion_order(own.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        const auto point = static_cast<Index>(own.first + order[i]);
        if (!std::ranges::binary_search(first, point)) block.insert(point, block.last_inserted());
        if (i % Progress::kReportEvery != 0) continue;
        progress.report(kOwn * static_cast<double>(i) / static_cast<double>(order.size()));
    }
}

void insert_foreign(Block& block, BlockProgress& progress)
{
    std::vector<Wanted> wanted = points_in_spheres(block, progress);
    double done = kFirstLook;
    while (!wanted.empty()) {
        progress.report(done);
        done += 0.5 * (kForeign - done);
        const std::vector<VertexHandle> inserted = insert_wanted(std::move(wanted), block);
        wanted = points_in_spheres_around(inserted, block);
    }
}

/// The cells as a flat array, instead of CGAL's.
UnsetArray<Cell> flattened(Block& block)
{
    UnsetArray<Cell> cells = unordered_cells(block.cells());
    block.clear();
    return_freed_memory();
    return cells;
}

std::vector<OpenFacet> open_facets(const UnsetArray<Cell>& cells)
{
    std::vector<OpenFacet> facets;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        for (std::uint32_t slot = 0; slot < 4; ++slot) {
            if (cells[i].neighbors[slot] != CellNumber::kNone) continue;
            OpenFacet facet{{}, static_cast<Index>(i), slot};
            for (int corner = 0; corner < 3; ++corner)
                facet.corners[corner] = cells[i].vertices[kFacetCorners[slot][corner]];
            std::ranges::sort(facet.corners);
            facets.push_back(facet);
        }
    }
    return facets;
}

/// The first points that are neither coincident nor collinear nor coplanar, at most four.
std::vector<Index> spanning_points(const std::vector<Vector3d>& points)
{
    std::vector<Index> found;
    for (std::size_t i = 0; i < points.size() && found.size() < 4; ++i) {
        const auto at = [&](std::size_t number) { return points[found[number]]; };
        const bool spans_more =
            found.empty() || (found.size() == 1 && points[i] != at(0)) ||
            (found.size() == 2 && !collinear(at(0), at(1), points[i])) ||
            (found.size() == 3 && orientation(at(0), at(1), at(2), points[i]) != 0);
        if (spans_more) found.push_back(static_cast<Index>(i));
    }
    return found;
}

} // namespace

std::vector<Index> first_points(const std::vector<Vector3d>& points)
{
    std::vector<Index> first = spanning_points(points);
    if (first.size() < 4) return first;
    std::vector<Vector3d> directions = {{1, 0, 0},  {0, 1, 0},  {0, 0, 1}, {1, 1, 1},
                                        {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}};
    for (const Vector3d& direction : directions) {
        const auto [low, high] = std::ranges::minmax_element(
            points, {}, [&](const Vector3d& p) { return direction.dot(p); });
        first.push_back(static_cast<Index>(low - points.begin()));
        first.push_back(static_cast<Index>(high - points.begin()));
    }
    sort_unique(first);
    return first;
}

BlockCells block_cells(const PointTree& tree, const std::vector<Index>& first, const PointRun& own,
                       CellCount& count, BlockProgress& progress)
{
    Block block(tree, own, count);
    insert_own(block, first, own, progress);
    insert_foreign(block, progress);
    const std::size_t num_made = block.cells().number_of_cells();
    BlockCells result;
    result.taken_in = block.cells().number_of_vertices() - own.size();
    result.cells = in_canonical_order(flattened(block), static_cast<Index>(own.first), own.size());
    result.open_facets = open_facets(result.cells);
    count.change(num_made, result.cells.size());
    return result;
}

} // namespace vcarve
