#include "samples.h"
#include "steps/5_labels/max_flow/max_flow.h"

#include <benchmark/benchmark.h>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <maxflow.h>

#include <algorithm>
#include <utility>

namespace vcarve::bench {
namespace {

void report(benchmark::State& state, std::size_t cells, std::size_t inside)
{
    state.counters["cells"] = static_cast<double>(cells);
    state.counters["inside"] = static_cast<double>(inside);
}

void bench_minimum_cut(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    std::size_t inside = 0;
    for (auto _ : state) {
        state.PauseTiming();
        FlowNetwork network = sample_network(state.range(0));
        state.ResumeTiming();
        const Labels labels = minimum_cut(cells, std::move(network));
        inside = static_cast<std::size_t>(std::count(labels.begin(), labels.end(), Label::inside));
    }
    report(state, cells.cells.size(), inside);
}

using Traits = boost::adjacency_list_traits<boost::vecS, boost::vecS, boost::directedS>;
struct Vertex {
    boost::default_color_type color;
    long distance;
    Traits::edge_descriptor predecessor;
};
struct Edge {
    std::int32_t capacity;
    std::int32_t residual;
    Traits::edge_descriptor reverse;
};
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::directedS, Vertex, Edge>;

void add_arcs(Graph& graph, std::pair<std::size_t, std::size_t> ends,
              std::pair<std::int32_t, std::int32_t> capacities)
{
    const auto forward = boost::add_edge(ends.first, ends.second, graph).first;
    const auto backward = boost::add_edge(ends.second, ends.first, graph).first;
    graph[forward] = {capacities.first, 0, backward};
    graph[backward] = {capacities.second, 0, forward};
}

Graph to_boost(const TetMesh& cells, const FlowNetwork& network)
{
    const std::size_t count = cells.cells.size();
    Graph graph(count + 2);
    for (Index cell = 0; cell < count; ++cell) {
        const std::int32_t excess = network.terminal_capacities[cell];
        if (excess > 0) add_arcs(graph, {count, cell}, {excess, 0});
        if (excess < 0) add_arcs(graph, {cell, count + 1}, {-excess, 0});
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = cells.cells[cell].neighbors[static_cast<std::size_t>(slot)];
            if (beyond < cell) continue;
            const auto mirror = static_cast<std::size_t>(cells.mirror(cell, slot));
            add_arcs(graph, {cell, beyond},
                     {network.arc_capacities[cell][static_cast<std::size_t>(slot)],
                      network.arc_capacities[beyond][mirror]});
        }
    }
    return graph;
}

void bench_boost(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const FlowNetwork& network = sample_network(state.range(0));
    const std::size_t count = cells.cells.size();
    std::size_t inside = 0;
    for (auto _ : state) {
        Graph graph = to_boost(cells, network);
        boost::boykov_kolmogorov_max_flow(
            graph, boost::get(&Edge::capacity, graph), boost::get(&Edge::residual, graph),
            boost::get(&Edge::reverse, graph), boost::get(&Vertex::predecessor, graph),
            boost::get(&Vertex::color, graph), boost::get(&Vertex::distance, graph),
            boost::get(boost::vertex_index, graph), count, count + 1);
        inside = 0;
        for (std::size_t cell = 0; cell < count; ++cell) {
            inside += graph[cell].color == boost::white_color ? 1U : 0U;
        }
    }
    report(state, count, inside);
}

/// Its authors' own program of Boykov and Kolmogorov's algorithm (PAMI 2004).
void bench_libmaxflow(benchmark::State& state)
{
    using FlowGraph = maxflow::Graph_III;
    const TetMesh& cells = sample_cells(state.range(0));
    const FlowNetwork& network = sample_network(state.range(0));
    const auto count = static_cast<int>(cells.cells.size());
    std::size_t inside = 0;
    for (auto _ : state) {
        FlowGraph graph(count, 2 * count);
        graph.add_node(count);
        for (Index cell = 0; cell < cells.cells.size(); ++cell) {
            const std::int32_t excess = network.terminal_capacities[cell];
            graph.add_tweights(static_cast<int>(cell), std::max(excess, 0), std::max(-excess, 0));
            for (int slot = 0; slot < 4; ++slot) {
                const auto at = static_cast<std::size_t>(slot);
                const Index beyond = cells.cells[cell].neighbors[at];
                if (beyond < cell) continue;
                const auto mirror = static_cast<std::size_t>(cells.mirror(cell, slot));
                graph.add_edge(static_cast<int>(cell), static_cast<int>(beyond),
                               network.arc_capacities[cell][at],
                               network.arc_capacities[beyond][mirror]);
            }
        }
        graph.maxflow();
        inside = 0;
        for (int cell = 0; cell < count; ++cell) {
            inside += graph.what_segment(cell, FlowGraph::SOURCE) == FlowGraph::SINK ? 1U : 0U;
        }
    }
    report(state, cells.cells.size(), inside);
}

BENCHMARK(bench_minimum_cut)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_boost)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_libmaxflow)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
