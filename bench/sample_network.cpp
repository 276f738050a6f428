#include "sample_network.h"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/spatial_sort.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <random>
#include <stdexcept>
#include <utility>
#include <vector>

namespace vcarve {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<Index, Kernel>;
using CellBase = CGAL::Triangulation_cell_base_with_info_3<Index, Kernel>;
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel,
                                   CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Eigen::Vector3d;

constexpr int kViews = 48;
constexpr double kUnit = 256; ///< steps of a full vote
constexpr std::int32_t kOutside = 1 << 24;

struct Point {
    Vector3d position;
    std::vector<int> views;
};

struct Crossing {
    Index cell;
    int slot; ///< of the facet crossed outwards
    double distance;
};

std::vector<Vector3d> view_centres()
{
    std::vector<Vector3d> centres;
    for (int view = 0; view < kViews; ++view) {
        const double z = 1.8 * (view + 0.5) / kViews - 0.9;
        const double angle = 2.399963 * view;
        const double ring = std::sqrt(1 - z * z);
        centres.emplace_back(3 * ring * std::cos(angle), 3 * ring * std::sin(angle), 3 * z);
    }
    return centres;
}

/// Up to `most` of the views in front of a surface element.
std::vector<int> views_in_front(const Vector3d& position, const Vector3d& normal, int most,
                                std::mt19937& random)
{
    static const std::vector<Vector3d> centres = view_centres();
    std::vector<int> views;
    for (int view = 0; view < kViews; ++view) {
        const Vector3d towards = centres[static_cast<std::size_t>(view)] - position;
        if (towards.dot(normal) > 0.4 * towards.norm()) views.push_back(view);
    }
    std::shuffle(views.begin(), views.end(), random);
    views.resize(std::min(views.size(), static_cast<std::size_t>(most)));
    return views;
}

std::vector<Point> sample_points(std::size_t count)
{
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> uniform(-1.5, 1.5);
    std::poisson_distribution<int> more_views(1.5);
    const double spacing = std::sqrt(4 * 3.14159 / static_cast<double>(count));
    std::vector<Point> points(count);
    for (std::size_t k = 0; k < count; ++k) {
        Vector3d direction(normal(random), normal(random), normal(random));
        direction.normalize();
        Point& point = points[k];
        if (k % 30 == 0) {
            point.position = Vector3d(uniform(random), uniform(random), uniform(random));
            direction = Vector3d(normal(random), normal(random), normal(random)).normalized();
        } else {
            const double bump = 0.1 * std::sin(7 * direction.x()) * std::sin(5 * direction.y() + 1);
            point.position = direction * (1 + bump + 0.7 * spacing * normal(random));
        }
        point.views = views_in_front(point.position, direction, 2 + more_views(random), random);
    }
    return points;
}

/// Points along a space-filling curve, as the mesher numbers them.
void sort_along_curve(std::vector<Point>& points)
{
    std::vector<std::pair<Kernel::Point_3, std::size_t>> keys;
    for (std::size_t k = 0; k < points.size(); ++k) {
        const Vector3d& p = points[k].position;
        keys.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), k);
    }
    using Map = CGAL::First_of_pair_property_map<std::pair<Kernel::Point_3, std::size_t>>;
    CGAL::hilbert_sort(keys.begin(), keys.end(),
                       CGAL::Spatial_sort_traits_adapter_3<Kernel, Map>());
    std::vector<Point> sorted;
    for (const auto& key : keys)
        sorted.push_back(std::move(points[key.second]));
    points = std::move(sorted);
}

/// Cells ascending by their sorted vertices.
TetMesh to_tet_mesh(Triangulation& triangulation, const std::vector<Point>& points)
{
    std::vector<std::pair<std::array<Index, 4>, Triangulation::Cell_handle>> order;
    triangulation.infinite_vertex()->info() = kInfinite;
    for (const auto cell : triangulation.all_cell_handles()) {
        std::array<Index, 4> key = {};
        for (int k = 0; k < 4; ++k)
            key[static_cast<std::size_t>(k)] = cell->vertex(k)->info();
        std::sort(key.begin(), key.end());
        order.emplace_back(key, cell);
    }
    std::sort(order.begin(), order.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (Index cell = 0; cell < order.size(); ++cell)
        order[cell].second->info() = cell;

    TetMesh mesh;
    mesh.cells.resize(order.size());
    mesh.mirrors.resize(order.size());
    mesh.cell_of_vertex.resize(points.size());
    for (Index cell = 0; cell < order.size(); ++cell) {
        const auto handle = order[cell].second;
        // Slots by ascending vertex: the orientation does not matter here.
        const auto& key = order[cell].first;
        for (std::size_t slot = 0; slot < 4; ++slot) {
            int corner = 0;
            while (handle->vertex(corner)->info() != key[slot])
                ++corner;
            const auto beyond = handle->neighbor(corner);
            const Index beyond_index = beyond->info();
            const auto& beyond_key = order[beyond_index].first;
            const Index opposite = beyond->vertex(beyond->index(handle))->info();
            const auto mirror =
                std::find(beyond_key.begin(), beyond_key.end(), opposite) - beyond_key.begin();
            mesh.cells[cell].vertices[slot] = key[slot];
            mesh.cells[cell].neighbors[slot] = beyond_index;
            mesh.mirrors[cell] |= static_cast<std::uint8_t>(mirror << (2 * slot));
            if (key[slot] != kInfinite && key[3] != kInfinite)
                mesh.cell_of_vertex[key[slot]] = cell;
        }
    }
    for (const Point& point : points)
        mesh.positions.push_back(point.position);
    return mesh;
}

TetMesh triangulate(const std::vector<Point>& points)
{
    std::vector<std::pair<Kernel::Point_3, Index>> vertices;
    for (Index k = 0; k < points.size(); ++k) {
        const Vector3d& p = points[k].position;
        vertices.emplace_back(Kernel::Point_3(p.x(), p.y(), p.z()), k);
    }
    Triangulation triangulation(vertices.begin(), vertices.end());
    return to_tet_mesh(triangulation, points);
}

/// Where a ray leaves the plane of a facet, or nothing if it enters there.
double exit_distance(const TetMesh& mesh, const Cell& cell, std::size_t slot,
                     const std::pair<Vector3d, Vector3d>& ray)
{
    std::array<Vector3d, 3> corners;
    std::size_t count = 0;
    for (std::size_t k = 0; k < 4; ++k)
        if (k != slot) corners[count++] = mesh.positions[cell.vertices[k]];
    Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    if (normal.dot(mesh.positions[cell.vertices[slot]] - corners[0]) > 0) normal = -normal;
    const double rise = normal.dot(ray.second);
    if (rise <= 0) return std::numeric_limits<double>::infinity();
    return normal.dot(corners[0] - ray.first) / rise;
}

/// Rounding decides on edges and vertices: good enough for a sample. Stops before infinite cells.
std::vector<Crossing> walk(const TetMesh& mesh, Index cell,
                           const std::pair<Vector3d, Vector3d>& ray, std::size_t most)
{
    std::vector<Crossing> crossings;
    while (!mesh.cells[cell].is_infinite() && crossings.size() < most) {
        Crossing best = {cell, -1, 1.0};
        for (std::size_t slot = 0; slot < 4; ++slot) {
            const double distance = exit_distance(mesh, mesh.cells[cell], slot, ray);
            if (distance < best.distance) best = {cell, static_cast<int>(slot), distance};
        }
        if (best.slot < 0) break;
        crossings.push_back(best);
        cell = mesh.cells[cell].neighbors[static_cast<std::size_t>(best.slot)];
    }
    return crossings;
}

/// The cell at a vertex that a ray from it enters.
Index first_cell(const TetMesh& mesh, Index vertex, const Vector3d& direction)
{
    const auto leaves_by_opposite_facet = [&](Index cell) {
        const Cell& at = mesh.cells[cell];
        if (at.is_infinite()) return false;
        const std::pair<Vector3d, Vector3d> ray(mesh.positions[vertex], direction);
        for (std::size_t slot = 0; slot < 4; ++slot) {
            if (at.vertices[slot] == vertex) continue;
            if (std::isfinite(exit_distance(mesh, at, slot, ray))) return false;
        }
        return true;
    };
    std::vector<Index> around = {mesh.cell_of_vertex[vertex]};
    for (std::size_t k = 0; k < around.size(); ++k) {
        if (leaves_by_opposite_facet(around[k])) return around[k];
        for (std::size_t slot = 0; slot < 4; ++slot) {
            if (mesh.cells[around[k]].vertices[slot] == vertex) continue;
            const Index beyond = mesh.cells[around[k]].neighbors[slot];
            if (std::find(around.begin(), around.end(), beyond) == around.end())
                around.push_back(beyond);
        }
    }
    return kInfinite;
}

struct Votes {
    TetMesh& mesh;
    FlowNetwork& network;
    double scale;

    std::int32_t soft(double weight, double distance) const
    {
        const double share = 1 - std::exp(-distance * distance / (2 * scale * scale));
        return static_cast<std::int32_t>(std::lround(weight * share));
    }

    void carry(const Crossing& crossing, std::int32_t forward, std::int32_t backward)
    {
        const int mirror = mesh.mirror(crossing.cell, crossing.slot);
        const auto slot = static_cast<std::size_t>(crossing.slot);
        const Index outer = mesh.cells[crossing.cell].neighbors[slot];
        network.residuals[outer][static_cast<std::size_t>(mirror)] += forward;
        network.residuals[crossing.cell][slot] += backward;
    }

    void add_front(const std::vector<Crossing>& crossings, double weight, double length)
    {
        auto carried = static_cast<std::int32_t>(std::lround(weight));
        for (auto at = crossings.rbegin(); at != crossings.rend(); ++at) {
            const std::int32_t capacity = soft(weight, at->distance * length);
            const std::int32_t pushed = std::min(carried, capacity);
            const auto slot = static_cast<std::size_t>(at->slot);
            network.excesses[mesh.cells[at->cell].neighbors[slot]] += carried - pushed;
            carry(*at, capacity - pushed, pushed);
            carried = pushed;
        }
        if (!crossings.empty()) network.excesses[crossings.front().cell] += carried;
    }

    /// `behind` is crossed away from the view: the arc to the beyond is a forward one.
    void add_behind(const Crossing& behind, double weight, double length)
    {
        const auto taken = static_cast<std::int32_t>(std::lround(weight));
        const std::int32_t pulled = std::min(taken, soft(weight, behind.distance * length));
        carry(behind, pulled, 0);
        const auto slot = static_cast<std::size_t>(behind.slot);
        network.excesses[mesh.cells[behind.cell].neighbors[slot]] -= taken - pulled;
        network.excesses[behind.cell] -= pulled;
    }
};

double spacing_quantile(const TetMesh& mesh)
{
    std::vector<double> lengths;
    for (const Cell& cell : mesh.cells)
        if (!cell.is_infinite())
            lengths.push_back(
                (mesh.positions[cell.vertices[0]] - mesh.positions[cell.vertices[1]]).norm());
    const auto quarter = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
    std::nth_element(lengths.begin(), quarter, lengths.end());
    return *quarter;
}

/// Both arcs of every facet alike; infinite cells are outside.
void add_quality(SampleNetwork& sample)
{
    std::mt19937 random(9);
    std::uniform_int_distribution<std::int32_t> quality(40, 256);
    for (Index cell = 0; cell < sample.cells.cells.size(); ++cell) {
        if (sample.cells.cells[cell].is_infinite()) sample.network.excesses[cell] += kOutside;
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = sample.cells.cells[cell].neighbors[static_cast<std::size_t>(slot)];
            if (beyond < cell) continue;
            const std::int32_t weight = quality(random);
            const auto mirror = static_cast<std::size_t>(sample.cells.mirror(cell, slot));
            sample.network.residuals[cell][static_cast<std::size_t>(slot)] += weight;
            sample.network.residuals[beyond][mirror] += weight;
        }
    }
}

template <typename T>
void read_all(std::ifstream& file, T* data, std::size_t count)
{
    file.read(reinterpret_cast<char*>(data), static_cast<std::streamsize>(count * sizeof(T)));
    if (!file) throw std::runtime_error("the network file ends early");
}

template <typename T>
void write_all(std::ofstream& file, const T* data, std::size_t count)
{
    file.write(reinterpret_cast<const char*>(data),
               static_cast<std::streamsize>(count * sizeof(T)));
}

} // namespace

SampleNetwork read_network(const std::string& path)
{
    std::ifstream file(path, std::ios::binary);
    std::uint64_t count = 0;
    read_all(file, &count, 1);
    SampleNetwork sample;
    sample.cells.cells.resize(count);
    sample.cells.mirrors.resize(count);
    sample.network.residuals.resize(count);
    sample.network.excesses.resize(count);
    for (Cell& cell : sample.cells.cells)
        read_all(file, cell.neighbors.data(), 4);
    read_all(file, sample.cells.mirrors.data(), count);
    read_all(file, sample.network.residuals.data(), count);
    read_all(file, sample.network.excesses.data(), count);
    return sample;
}

void write_network(const std::string& path, const SampleNetwork& sample)
{
    std::ofstream file(path, std::ios::binary);
    const std::uint64_t count = sample.cells.cells.size();
    write_all(file, &count, 1);
    for (const Cell& cell : sample.cells.cells)
        write_all(file, cell.neighbors.data(), 4);
    write_all(file, sample.cells.mirrors.data(), count);
    write_all(file, sample.network.residuals.data(), count);
    write_all(file, sample.network.excesses.data(), count);
    if (!file) throw std::runtime_error("cannot write " + path);
}

SampleNetwork make_sample_network(std::size_t count)
{
    std::vector<Point> points = sample_points(count);
    sort_along_curve(points);
    SampleNetwork sample;
    sample.cells = triangulate(points);
    sample.network.residuals.assign(sample.cells.cells.size(), {0, 0, 0, 0});
    sample.network.excesses.assign(sample.cells.cells.size(), 0);

    const std::vector<Vector3d> centres = view_centres();
    Votes votes = {sample.cells, sample.network, 0.5 * spacing_quantile(sample.cells)};
    for (Index vertex = 0; vertex < points.size(); ++vertex) {
        const auto views = static_cast<double>(points[vertex].views.size());
        const double weight = kUnit * (1 - std::exp(-views * views / 18));
        for (const int view : points[vertex].views) {
            const Vector3d& from = points[vertex].position;
            const Vector3d towards = centres[static_cast<std::size_t>(view)] - from;
            const Index front = first_cell(sample.cells, vertex, towards);
            if (front != kInfinite)
                votes.add_front(walk(sample.cells, front, {from, towards}, 100000), weight,
                                towards.norm());
            const Index back = first_cell(sample.cells, vertex, -towards);
            if (back == kInfinite) continue;
            const auto behind = walk(sample.cells, back, {from, -towards}, 1);
            if (!behind.empty()) votes.add_behind(behind[0], weight, towards.norm());
        }
    }
    add_quality(sample);
    return sample;
}

} // namespace vcarve
