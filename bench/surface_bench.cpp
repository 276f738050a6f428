#include "mesh/half_edge_mesh.h"
#include "samples.h"
#include "steps/5_labels/boundary.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/cleanup.h"
#include "steps/6_surface/face_rules.h"

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

FaceFlags seen(std::int64_t size, const TriMesh& boundary)
{
    const TetMesh& cells = sample_cells(size);
    const Labels& labels = sample_labels(size);
    const FaceVisibility visibility(cells, labels, sample_scene(size));
    return seen_faces({boundary, boundary_facets(cells, labels), visibility});
}

TriMesh sample_boundary(std::int64_t size)
{
    return extract_surface(sample_cells(size), sample_labels(size), sample_scene(size));
}

void bench_seen_faces(benchmark::State& state)
{
    const TriMesh boundary = sample_boundary(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(seen(state.range(0), boundary));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(boundary.faces.size()));
}

void bench_clean_surface(benchmark::State& state)
{
    const TriMesh boundary = sample_boundary(state.range(0));
    const TriMesh surface = with_faces(boundary, seen(state.range(0), boundary));
    for (auto _ : state) {
        benchmark::DoNotOptimize(clean_surface(surface, CleanupOptions()));
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(surface.faces.size()));
}

BENCHMARK(bench_extract_surface)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_seen_faces)->Apply(sample_sizes)->UseRealTime();
BENCHMARK(bench_clean_surface)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
