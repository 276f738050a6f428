#include "samples.h"
#include "steps/4_visibility/trace.h"
#include "walk_all_sights.h"

#include <benchmark/benchmark.h>

namespace vcarve::bench {
namespace {

/// All sights, with everything they add to the network.
void bench_cast_rays(benchmark::State& state)
{
    const TetMesh& cells = sample_cells(state.range(0));
    const Scene& scene = sample_scene(state.range(0));
    const TraceOptions options;
    Log silent;
    for (auto _ : state) {
        Stage stage(silent, "sights");
        const RayCaster caster(cells, scene, measure_scales(cells, scene), options);
        VisibilityEnergy energy;
        caster.cast(photographs(scene), energy, stage);
        benchmark::DoNotOptimize(energy);
    }
    report_crossings(state, walk_all_sights(cells, scene));
}

BENCHMARK(bench_cast_rays)->Apply(sample_sizes);

} // namespace
} // namespace vcarve::bench
