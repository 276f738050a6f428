#include "paper/sample_surface.h"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <cmath>

namespace vcarve::paper {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using FlatVertex = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using Flat =
    CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<FlatVertex>>;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;
using Cell = CGAL::Triangulation_cell_base_with_info_3<bool, Kernel>;
using Delaunay =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
using Triangle = std::array<std::uint32_t, 3>;

/// Adds points until all diametral and circumscribed balls are empty.
class Refinement {
  public:
    Refinement(const BoxSolid& solid, std::int64_t max_radius, std::mt19937_64& random)
        : solid_(solid),
          sides_(solid.sides()),
          edges_(solid.edges()),
          max_radius_(max_radius),
          random_(random)
    {
        for (const Edge& edge : edges_) {
            add(edge.begin);
            add(edge.end);
        }
    }

    std::vector<Spot> run()
    {
        while (split_an_edge() || split_a_triangle()) {
        }
        return samples_;
    }

  private:
    void add(const Spot& spot)
    {
        if (std::find(samples_.begin(), samples_.end(), spot) == samples_.end()) {
            samples_.push_back(spot);
        }
    }

    std::int64_t jitter(std::int64_t reach)
    {
        return std::uniform_int_distribution<std::int64_t>(-reach, reach)(random_);
    }

    static bool encroaches(const Spot& spot, const Edge& edge)
    {
        return spot != edge.begin && spot != edge.end &&
               (spot - edge.begin).dot(spot - edge.end) <= 0;
    }

    void split(std::size_t index)
    {
        const Edge edge = edges_[index];
        const Spot way = edge.end - edge.begin;
        const std::int64_t length = way.cwiseAbs().maxCoeff();
        const Spot step = way / length;
        const Spot middle = edge.begin + step * (length / 2 + jitter(length / 12));
        edges_[index].end = middle;
        edges_.push_back({middle, edge.end});
        samples_.push_back(middle);
    }

    bool split_an_edge()
    {
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            const bool bad = std::any_of(samples_.begin(), samples_.end(), [&](const Spot& spot) {
                return encroaches(spot, edges_[i]);
            });
            if (bad) {
                split(i);
                return true;
            }
        }
        return false;
    }

    std::vector<Triangle> triangles(const Side& side) const
    {
        Flat flat;
        for (std::uint32_t i = 0; i < samples_.size(); ++i) {
            if (samples_[i][side.axis] != side.plane) continue;
            const Kernel::Point_2 place(samples_[i][(side.axis + 1) % 3],
                                        samples_[i][(side.axis + 2) % 3]);
            flat.insert(place)->info() = i;
        }
        std::vector<Triangle> result;
        for (auto face = flat.finite_faces_begin(); face != flat.finite_faces_end(); ++face) {
            const Triangle t{face->vertex(0)->info(), face->vertex(1)->info(),
                             face->vertex(2)->info()};
            const Spot sum = samples_[t[0]] + samples_[t[1]] + samples_[t[2]];
            if (solid_.on_side(side, sum)) result.push_back(t);
        }
        return result;
    }

    Eigen::Vector3d circumcenter(const Triangle& t) const
    {
        const Eigen::Vector3d a = samples_[t[0]].cast<double>();
        const Eigen::Vector3d u = samples_[t[1]].cast<double>() - a;
        const Eigen::Vector3d v = samples_[t[2]].cast<double>() - a;
        const Eigen::Vector3d normal = u.cross(v);
        const Eigen::Vector3d across = u.squaredNorm() * v - v.squaredNorm() * u;
        return a + across.cross(normal) / (2.0 * normal.squaredNorm());
    }

    bool is_bad(const Triangle& t) const
    {
        const Eigen::Vector3d center = circumcenter(t);
        const double radius_sq = (samples_[t[0]].cast<double>() - center).squaredNorm();
        if (radius_sq > static_cast<double>(max_radius_ * max_radius_)) return true;
        for (std::uint32_t i = 0; i < samples_.size(); ++i) {
            const bool own = std::find(t.begin(), t.end(), i) != t.end();
            const double distance_sq = (samples_[i].cast<double>() - center).squaredNorm();
            if (!own && distance_sq <= 1.0001 * radius_sq) return true;
        }
        return false;
    }

    /// Adds the circumcenter of a triangle, or splits an edge that would be too near to it.
    void split(const Triangle& t, const Side& side)
    {
        const Eigen::Vector3d center = circumcenter(t);
        const double radius = (samples_[t[0]].cast<double>() - center).norm();
        const auto reach = static_cast<std::int64_t>(radius / 10);
        Spot spot;
        for (int k = 0; k < 3; ++k) {
            spot[k] = std::llround(center[k]) + (k == side.axis ? 0 : jitter(reach));
        }
        for (std::size_t i = 0; i < edges_.size(); ++i) {
            if (encroaches(spot, edges_[i])) {
                split(i);
                return;
            }
        }
        add(spot);
    }

    bool split_a_triangle()
    {
        for (const Side& side : sides_) {
            for (const Triangle& t : triangles(side)) {
                if (is_bad(t)) {
                    split(t, side);
                    return true;
                }
            }
        }
        return false;
    }

    const BoxSolid& solid_;
    std::vector<Side> sides_;
    std::vector<Edge> edges_;
    std::vector<Spot> samples_;
    std::int64_t max_radius_;
    std::mt19937_64& random_;
};

Delaunay build(const std::vector<Spot>& samples)
{
    Delaunay delaunay;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        const Kernel::Point_3 place(samples[i][0], samples[i][1], samples[i][2]);
        delaunay.insert(place)->info() = i;
    }
    return delaunay;
}

/// Whether no sphere around a cell passes through a fifth sample.
bool is_unique(const Delaunay& delaunay)
{
    for (const auto& facet : delaunay.finite_facets()) {
        const auto [here, slot] = facet;
        const auto there = here->neighbor(slot);
        if (delaunay.is_infinite(here) || delaunay.is_infinite(there)) continue;
        const auto& fifth = there->vertex(there->index(here))->point();
        if (delaunay.side_of_sphere(here, fifth) == CGAL::ON_BOUNDARY) return false;
    }
    return true;
}

std::array<std::uint32_t, 4> vertices(const Delaunay::Cell_handle& cell)
{
    return {cell->vertex(0)->info(), cell->vertex(1)->info(), cell->vertex(2)->info(),
            cell->vertex(3)->info()};
}

} // namespace

std::vector<Spot> sample_surface(const BoxSolid& solid, std::int64_t max_radius,
                                 std::mt19937_64& random)
{
    return Refinement(solid, max_radius, random).run();
}

std::optional<Cells> triangulate(const BoxSolid& solid, const std::vector<Spot>& samples)
{
    const Delaunay delaunay = build(samples);
    if (!is_unique(delaunay)) return std::nullopt;

    // Classify the cells; info() is whether a cell is solid.
    Cells result;
    for (const auto& cell : delaunay.all_cell_handles()) {
        cell->info() = false;
        if (delaunay.is_infinite(cell)) continue;
        const auto v = vertices(cell);
        const auto meets =
            solid.meets({samples[v[0]], samples[v[1]], samples[v[2]], samples[v[3]]});
        if (meets.solid && meets.empty) return std::nullopt;
        cell->info() = meets.solid;
        (meets.solid ? result.solid : result.empty).push_back(v);
    }

    // The boundary consists of the facets with a solid cell on one side only.
    for (const auto& cell : delaunay.all_cell_handles()) {
        for (int i = 0; i < 4 && cell->info(); ++i) {
            if (cell->neighbor(i)->info()) continue;
            // CGAL numbers a facet's corners counterclockwise from inside the cell.
            std::array<std::uint32_t, 3> face;
            for (int k = 0; k < 3; ++k) {
                face[2 - k] = cell->vertex(Delaunay::vertex_triple_index(i, k))->info();
            }
            result.boundary.push_back(face);
        }
    }
    return result;
}

} // namespace vcarve::paper
