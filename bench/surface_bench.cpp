#include "samples.h"
#include "surface/cleanup.h"
#include "surface/extract.h"
#include "surface/support.h"
#include "surface/webs.h"

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

void bench_webs(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    const Labels& labels = sample_labels(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(cells_behind_webs(cells, labels, scene, WebOptions()));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(cells.cells.size()));
}

void bench_clean_surface(benchmark::State& state)
{
    const Scene& scene = sample_scene(state.range(0));
    const TriMesh surface = keep_supported(
        extract_surface(sample_cells(state.range(0)), sample_labels(state.range(0)), scene), scene,
        SupportOptions());
    for (auto _ : state) {
        benchmark::DoNotOptimize(clean_surface(surface, CleanupOptions()));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(surface.faces.size()));
}

BENCHMARK(bench_webs)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_extract_surface)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_keep_supported)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_clean_surface)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
