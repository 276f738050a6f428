#include "samples.h"
#include "surface/extract.h"
#include "surface/support.h"

#include <benchmark/benchmark.h>

namespace vcarve::bench {
namespace {

void bench_extract_surface(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    const Labels& labels = sample_labels(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(extract_surface(cells, labels, scene));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.cells.size()));
}

void bench_keep_supported(benchmark::State& state)
{
    const Scene& scene = sample_scene(state.range(0));
    const TriMesh boundary =
        extract_surface(sample_cells(state.range(0)), sample_labels(state.range(0)), scene);
    for (auto _ : state) {
        benchmark::DoNotOptimize(keep_supported(boundary, scene, SupportOptions()));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boundary.faces.size()));
}

BENCHMARK(bench_extract_surface)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_keep_supported)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
