// Costs of the triangulation at once and in blocks, and the share of points that blocks take in
// from other blocks.

#include "samples.h"
#include "steps/3_cells/block_cells.h"
#include "steps/3_cells/triangulate.h"
#include "steps/3_cells/triangulate_blocks.h"

#include <benchmark/benchmark.h>

#include <vector>

namespace vcarve::bench {
namespace {

void triangulate_at_once(benchmark::State& state)
{
    const Scene& scene = sample_scene(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(triangulate(scene).cells.data());
    }
    state.SetItemsProcessed(state.iterations() * state.range(0));
}
BENCHMARK(triangulate_at_once)
    ->Apply(sample_sizes)
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

void triangulate_in_blocks(benchmark::State& state)
{
    const Scene& scene = sample_scene(state.range(0));
    const auto num_blocks = static_cast<std::size_t>(state.range(1));
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            vcarve::triangulate_in_blocks(scene, {.count = num_blocks}).value().cells.data());
    }
    const PointTree tree(scene.positions);
    const std::size_t size = scene.num_points() / num_blocks;
    const std::size_t first = num_blocks / 2 * size;
    ProgressCount silent({}, size);
    CellCount count(kAnyCells);
    BlockProgress progress(silent, size);
    const BlockCells block =
        block_cells(tree, first_points(scene.positions), {first, first + size}, count, progress);
    state.SetItemsProcessed(state.iterations() * state.range(0));
    state.counters["taken in"] = static_cast<double>(block.taken_in) / static_cast<double>(size);
}
BENCHMARK(triangulate_in_blocks)
    ->ArgsProduct({{1'000'000}, {8, 64}})
    ->MeasureProcessCPUTime()
    ->Unit(benchmark::kMillisecond);

} // namespace
} // namespace vcarve::bench
