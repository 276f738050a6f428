#include "samples.h"
#include "steps/3_visibility/trace.h"
#include "walk_all_sights.h"

#include <benchmark/benchmark.h>

namespace vcarve::bench {
namespace {

/// All sights, with everything they add to the network.
void bench_trace_sights(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    Log silent;
    for (auto _ : state) {
        Stage stage(silent, "sights");
        benchmark::DoNotOptimize(trace_sights(cells, scene, TraceOptions(), stage));
    }
    report_crossings(state, walk_all_sights(cells, scene));
}

BENCHMARK(bench_trace_sights)->Apply(sample_sizes);

} // namespace
} // namespace vcarve::bench
