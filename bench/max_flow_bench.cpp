#include "label/max_flow.h"
#include "sample_network.h"

#include <benchmark/benchmark.h>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

// Set VCARVE_NETWORK to the path of a raw file (see sample_network.h) to measure that network as
// `0` points; a sample is written there as VCARVE_NETWORK_OUT says.

namespace vcarve {
namespace {

const SampleNetwork& sample(std::int64_t points)
{
    static std::map<std::int64_t, SampleNetwork> samples;
    const auto found = samples.find(points);
    if (found != samples.end()) return found->second;
    const char* input = std::getenv("VCARVE_NETWORK");
    SampleNetwork made = points == 0 && input != nullptr
                             ? read_network(input)
                             : make_sample_network(static_cast<std::size_t>(points));
    if (const char* output = std::getenv("VCARVE_NETWORK_OUT")) write_network(output, made);
    return samples.emplace(points, std::move(made)).first->second;
}

void report(benchmark::State& state, const SampleNetwork& measured, std::size_t inside)
{
    state.counters["cells"] = static_cast<double>(measured.cells.cells.size());
    state.counters["inside"] = static_cast<double>(inside);
}

void bench_minimum_cut(benchmark::State& state)
{
    const SampleNetwork& measured = sample(state.range(0));
    std::size_t inside = 0;
    for (auto _ : state) {
        state.PauseTiming();
        FlowNetwork network = measured.network;
        state.ResumeTiming();
        const Labels labels = minimum_cut(measured.cells, std::move(network));
        inside = static_cast<std::size_t>(std::count(labels.begin(), labels.end(), Label::inside));
    }
    report(state, measured, inside);
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
        const std::int32_t excess = network.excesses[cell];
        if (excess > 0) add_arcs(graph, {count, cell}, {excess, 0});
        if (excess < 0) add_arcs(graph, {cell, count + 1}, {-excess, 0});
        for (int slot = 0; slot < 4; ++slot) {
            const Index beyond = cells.cells[cell].neighbors[static_cast<std::size_t>(slot)];
            if (beyond < cell) continue;
            const auto mirror = static_cast<std::size_t>(cells.mirror(cell, slot));
            add_arcs(graph, {cell, beyond},
                     {network.residuals[cell][static_cast<std::size_t>(slot)],
                      network.residuals[beyond][mirror]});
        }
    }
    return graph;
}

void bench_boost(benchmark::State& state)
{
    const SampleNetwork& measured = sample(state.range(0));
    std::size_t inside = 0;
    for (auto _ : state) {
        Graph graph = to_boost(measured.cells, measured.network);
        const std::size_t count = measured.cells.cells.size();
        boost::boykov_kolmogorov_max_flow(
            graph, boost::get(&Edge::capacity, graph), boost::get(&Edge::residual, graph),
            boost::get(&Edge::reverse, graph), boost::get(&Vertex::predecessor, graph),
            boost::get(&Vertex::color, graph), boost::get(&Vertex::distance, graph),
            boost::get(boost::vertex_index, graph), count, count + 1);
        inside = 0;
        for (std::size_t cell = 0; cell < count; ++cell)
            inside += graph[cell].color == boost::white_color ? 1U : 0U;
    }
    report(state, measured, inside);
}

// CPU time is that of all threads: on a busy machine it compares better than the time on the wall.
void measure(benchmark::internal::Benchmark* bench)
{
    bench->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}

BENCHMARK(bench_minimum_cut)->Arg(100000)->Arg(1000000)->Apply(measure);
BENCHMARK(bench_boost)->Arg(100000)->Arg(1000000)->Apply(measure);
BENCHMARK(bench_minimum_cut)->Name("bench_minimum_cut_of_file")->Arg(0)->Apply(measure);
BENCHMARK(bench_boost)->Name("bench_boost_of_file")->Arg(0)->Apply(measure);

} // namespace
} // namespace vcarve
