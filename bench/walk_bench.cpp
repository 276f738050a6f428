// The cost of a crossing on one core: our walk over flat cells, and the same walk over CGAL's cells
// with CGAL's exact predicates.

#include "samples.h"
#include "steps/4_visibility/walk.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <benchmark/benchmark.h>

#include <iterator>
#include <memory>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vcarve::bench {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Delaunay = CGAL::Delaunay_triangulation_3<
    Kernel,
    CGAL::Triangulation_data_structure_3<CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>,
                                         CGAL::Delaunay_triangulation_cell_base_3<Kernel>>>;
using CellHandle = Delaunay::Cell_handle;
using VertexHandle = Delaunay::Vertex_handle;

Point cgal_point(const Eigen::Vector3d& p)
{
    return {p.x(), p.y(), p.z()};
}

/// Rays from one vertex of CGAL's triangulation. They must meet no edge and no other vertex.
class CgalWalk {
  public:
    CgalWalk(const Delaunay& triangulation, VertexHandle vertex)
        : triangulation_(triangulation), vertex_(vertex)
    {
        triangulation_.finite_incident_cells(vertex, std::back_inserter(star_));
    }

    /// The number of facets that the segment from the vertex to the target crosses.
    std::size_t count_crossings(const Point& target)
    {
        target_ = target;
        if (!find_first_cell()) return 0;
        std::size_t crossings = 0;
        while (CGAL::orientation(corners_[0]->point(), corners_[1]->point(), corners_[2]->point(),
                                 target_) == CGAL::NEGATIVE) {
            ++crossings;
            if (triangulation_.is_infinite(cell_->neighbor(slot_))) break;
            enter_neighbor();
        }
        return crossings;
    }

  private:
    /// Whether the ray passes left of the edge from a to b, seen from the vertex.
    bool passes_left_of(VertexHandle a, VertexHandle b) const
    {
        const CGAL::Orientation side =
            CGAL::orientation(vertex_->point(), target_, a->point(), b->point());
        if (side == CGAL::COPLANAR) throw std::logic_error("a ray of the sample meets an edge");
        return side == CGAL::NEGATIVE;
    }

    bool find_first_cell()
    {
        for (const CellHandle cell : star_) {
            cell_ = cell;
            slot_ = cell->index(vertex_);
            for (std::size_t i = 0; i < 3; ++i) {
                corners_[i] = cell->vertex(kFacetCorners[slot_][i]);
            }
            if (passes_left_of(corners_[0], corners_[1]) &&
                passes_left_of(corners_[1], corners_[2]) &&
                passes_left_of(corners_[2], corners_[0])) {
                return true;
            }
        }
        return false;
    }

    void enter_neighbor()
    {
        const CellHandle next = cell_->neighbor(slot_);
        const VertexHandle tip = next->vertex(next->index(cell_));
        // The tip replaces the corner that is not on the facet through which the ray leaves.
        std::size_t replaced = 0;
        if (passes_left_of(corners_[0], tip)) {
            replaced = passes_left_of(corners_[2], tip) ? 0 : 1;
        } else {
            replaced = passes_left_of(corners_[1], tip) ? 2 : 0;
        }
        slot_ = next->index(std::exchange(corners_[replaced], tip));
        cell_ = next;
    }

    const Delaunay& triangulation_;
    VertexHandle vertex_;
    std::vector<CellHandle> star_;
    Point target_;
    CellHandle cell_;
    int slot_ = 0;
    std::array<VertexHandle, 3> corners_; ///< counter-clockwise seen from the vertex
};

/// CGAL's triangulation of a sample, with vertices in the order of the scene.
struct CgalCells {
    explicit CgalCells(const Scene& scene) : vertices(scene.num_points())
    {
        std::vector<std::pair<Point, Index>> points;
        for (const Eigen::Vector3d& p : scene.positions) {
            points.emplace_back(cgal_point(p), static_cast<Index>(points.size()));
        }
        triangulation.insert(points.begin(), points.end());
        for (const VertexHandle vertex : triangulation.finite_vertex_handles()) {
            vertices[vertex->info()] = vertex;
        }
    }

    Delaunay triangulation;
    std::vector<VertexHandle> vertices;
};

const CgalCells& cgal_cells(std::int64_t points)
{
    static std::int64_t made_for = -1;
    static std::unique_ptr<CgalCells> made;
    if (made_for != points) made = std::make_unique<CgalCells>(sample_scene(points));
    made_for = points;
    return *made;
}

std::size_t crossings_of_cgal(const CgalCells& cells, const Scene& scene)
{
    std::size_t crossings = 0;
    for (std::size_t vertex = 0; vertex < scene.num_points(); ++vertex) {
        CgalWalk walk(cells.triangulation, cells.vertices[vertex]);
        for (const std::uint32_t view : scene.tracks[vertex]) {
            crossings += walk.count_crossings(cgal_point(scene.views[view].center));
        }
    }
    return crossings;
}

/// The number of facets that all rays of a scene cross.
std::size_t walk_all_rays(const TetMesh& cells, const Scene& scene)
{
    std::vector<Ray> rays;
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            rays.push_back({vertex, scene.views[view].center});
        }
    }
    std::size_t crossings = 0;
    RayWalk(cells).along_each(
        rays.size(), [&](std::size_t k) { return rays[k]; },
        [&](std::size_t, Index, int) {
            ++crossings;
            return true;
        },
        [](std::size_t, const WalkEnds&) {});
    return crossings;
}

void report_crossings(benchmark::State& state, std::size_t crossings)
{
    state.counters["crossings"] = static_cast<double>(crossings);
    state.counters["CPU_s_a_crossing"] = benchmark::Counter(
        static_cast<double>(crossings),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bench_walk(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    std::size_t crossings = 0;
    for (auto _ : state) {
        crossings = walk_all_rays(cells, scene);
    }
    report_crossings(state, crossings);
}

void bench_walk_of_cgal(benchmark::State& state)
{
    const CgalCells& cells = cgal_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    std::size_t crossings = 0;
    for (auto _ : state) {
        crossings = crossings_of_cgal(cells, scene);
    }
    report_crossings(state, crossings);
    if (crossings != walk_all_rays(sample_cells(state.range(0)), scene)) {
        state.SkipWithError("the walks cross different numbers of facets");
    }
}

BENCHMARK(bench_walk)->Apply(sample_sizes);
BENCHMARK(bench_walk_of_cgal)->Apply(sample_sizes);

} // namespace
} // namespace vcarve::bench
