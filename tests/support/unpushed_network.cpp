#include "support/unpushed_network.h"

#include "steps/4_visibility/ray_weights.h"
#include "steps/4_visibility/walk.h"
#include "support/exact_ray.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr double kSteps = 256.0; // capacity of a ray of full weight

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Node {
    boost::default_color_type color;
    long distance;
    Traits::edge_descriptor predecessor;
};
struct Arc {
    std::int64_t capacity;
    std::int64_t residual;
    Traits::edge_descriptor reverse;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Node, Arc>;

void add_arc(Graph& graph, std::size_t from, std::size_t to, std::int64_t capacity)
{
    const auto forward = boost::add_edge(from, to, graph).first;
    const auto backward = boost::add_edge(to, from, graph).first;
    graph[forward] = {capacity, 0, backward};
    graph[backward] = {0, 0, forward};
}

/// b(d) = 1 - exp(-d^2 / 2 s^2); a step if s is 0.
double softened(double distance, double sigma)
{
    return sigma == 0.0 ? 1.0 : 1.0 - std::exp(-distance * distance / (2.0 * sigma * sigma));
}

/// 1 - exp(-n^2 / 2 s^2); 1 for all points if s is 0.
double weight(std::size_t views, double sigma)
{
    const auto n = static_cast<double>(views);
    return sigma == 0.0 ? 1.0 : 1.0 - std::exp(-n * n / (2.0 * sigma * sigma));
}

/// The median number of views of points that have views; the larger of the middle two if even.
std::size_t median_views(const Scene& scene)
{
    std::vector<std::size_t> views;
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        views.push_back(scene.tracks[point].size());
    }
    std::sort(views.begin(), views.end());
    views.erase(views.begin(), std::upper_bound(views.begin(), views.end(), 0U));
    return views[views.size() / 2];
}

/// The terms of one ray from a vertex to a view.
class RayTerms {
  public:
    RayTerms(const TetMesh& mesh, Index vertex, double weight, double sigma)
        : mesh_(mesh), vertex_(vertex), full_(std::lround(kSteps * weight)), sigma_(sigma)
    {
    }

    /// Adds arcs towards the point, and a source in the view's cell and at the end of each segment.
    void add_outside(const Vector3d& center, UnpushedNetwork& network) const
    {
        const double length = (center - mesh_.positions[vertex_]).norm();
        Index entered = kInfinite;
        for (const auto& [facet, share] : crossings_by_brute_force(mesh_, vertex_, center)) {
            const std::int64_t flow = weight(share * length);
            const Index beyond = mesh_.cells[facet.cell].neighbors[facet.slot];
            add_at_gap(network.sources, entered, facet.cell, flow);
            network.arcs[beyond][mesh_.mirror(facet.cell, facet.slot)] += flow;
            entered = beyond;
        }
        add_at_end(network.sources, entered, center);
    }

    /// Adds arcs away from the view, and a sink in the last cell and at the end of each segment.
    void add_inside(const Vector3d& center, double depth, UnpushedNetwork& network) const
    {
        const Vector3d& point = mesh_.positions[vertex_];
        if (depth == 0.0) {
            const Vector3d target = point + (point - center);
            add(network.sinks, first_cell_by_brute_force(mesh_, vertex_, target), full_);
            return;
        }
        const Vector3d target = point + depth * (point - center).normalized();
        Index entered = kInfinite;
        for (const auto& [facet, share] : crossings_by_brute_force(mesh_, vertex_, target)) {
            const std::int64_t flow = weight(share * depth);
            add_at_gap(network.sinks, entered, facet.cell, flow);
            network.arcs[facet.cell][facet.slot] += flow;
            entered = mesh_.cells[facet.cell].neighbors[facet.slot];
        }
        add_at_end(network.sinks, entered, target);
    }

  private:
    using Capacities = std::vector<std::int64_t>;

    static void add(Capacities& terminals, Index cell, std::int64_t capacity)
    {
        if (cell != kInfinite) {
            terminals[cell] += capacity;
        }
    }

    /// If the ray leaves another cell than it entered, it met an edge or a vertex, and no arc
    /// connects the cells. The segment before then ends in a terminal.
    static void add_at_gap(Capacities& terminals, Index entered, Index left, std::int64_t flow)
    {
        if (entered != kInfinite && entered != left) {
            terminals[entered] += flow;
        }
    }

    void add_at_end(Capacities& terminals, Index entered, const Vector3d& target) const
    {
        RayWalk walk(mesh_, vertex_);
        const Index last = walk.to(target, [](Index, int) {}).last;
        add_at_gap(terminals, entered, last, full_);
        add(terminals, last, full_);
    }

    std::int64_t weight(double distance) const
    {
        return std::lround(static_cast<double>(full_) * softened(distance, sigma_));
    }

    const TetMesh& mesh_;
    Index vertex_;
    std::int64_t full_;
    double sigma_;
};

} // namespace

UnpushedNetwork network_of_rays(const TetMesh& mesh, const Scene& scene,
                                const TraceOptions& options)
{
    const std::size_t count = mesh.cells.size();
    UnpushedNetwork network{std::vector<std::int64_t>(count, 0),
                            std::vector<std::int64_t>(count, 0),
                            std::vector<std::array<std::int64_t, 4>>(count, {0, 0, 0, 0})};
    const double sigma = options.distance_sigma * short_edge_length(mesh);
    const double usual = weight(median_views(scene), options.views_sigma);
    for (Index vertex = 0; vertex < mesh.positions.size(); ++vertex) {
        const double share = weight(scene.tracks[vertex].size(), options.views_sigma) / usual;
        const RayTerms ray(mesh, vertex, share, sigma);
        for (const std::uint32_t view : scene.tracks[vertex]) {
            ray.add_outside(scene.views[view].center, network);
            ray.add_inside(scene.views[view].center, options.sink_depth * sigma, network);
        }
    }
    return network;
}

void pin_outside(const TetMesh& mesh, const std::vector<Index>& cells_of_views,
                 UnpushedNetwork& network)
{
    constexpr std::int64_t kUnbounded = std::int64_t{1} << 50;
    for (const Index cell : cells_of_views) {
        if (cell != kInfinite) {
            network.sources[cell] = kUnbounded;
        }
    }
    for (Index cell = 0; cell < mesh.cells.size(); ++cell) {
        if (mesh.cells[cell].is_infinite()) {
            network.sources[cell] = kUnbounded;
        }
    }
}

Labels boost_minimum_cut(const TetMesh& mesh, const UnpushedNetwork& network)
{
    const std::size_t count = mesh.cells.size();
    Graph graph(count + 2);
    for (Index cell = 0; cell < count; ++cell) {
        add_arc(graph, count, cell, network.sources[cell]);
        add_arc(graph, cell, count + 1, network.sinks[cell]);
        for (int slot = 0; slot < 4; ++slot) {
            add_arc(graph, cell, mesh.cells[cell].neighbors[slot], network.arcs[cell][slot]);
        }
    }
    boost::boykov_kolmogorov_max_flow(
        graph, boost::get(&Arc::capacity, graph), boost::get(&Arc::residual, graph),
        boost::get(&Arc::reverse, graph), boost::get(&Node::predecessor, graph),
        boost::get(&Node::color, graph), boost::get(&Node::distance, graph),
        boost::get(boost::vertex_index, graph), count, count + 1);

    // The nodes that can still reach the sink are inside.
    Labels labels(count + 2, Label::outside);
    std::vector<std::size_t> open = {count + 1};
    while (!open.empty()) {
        const std::size_t reached = open.back();
        open.pop_back();
        for (const auto& arc : boost::make_iterator_range(boost::out_edges(reached, graph))) {
            const std::size_t from = boost::target(arc, graph);
            if (labels[from] == Label::outside && graph[graph[arc].reverse].residual > 0) {
                labels[from] = Label::inside;
                open.push_back(from);
            }
        }
    }
    labels.resize(count);
    return labels;
}

} // namespace vcarve
