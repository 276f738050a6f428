#include "samples.h"
#include "steps/5_labels/max_flow/max_flow.h"

#include <benchmark/benchmark.h>
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

/// The implementation by Boykov and Kolmogorov (PAMI 2004).
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
BENCHMARK(bench_libmaxflow)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
