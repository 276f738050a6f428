#include "io/colmap/colmap_model.h"
#include "samples.h"

#include <benchmark/benchmark.h>

namespace vcarve::bench {
namespace {

void bench_read(benchmark::State& state)
{
    const std::filesystem::path& folder = sample_folder(state.range(0));
    std::size_t points = 0;
    for (auto _ : state) {
        points = read_colmap_model(folder, ModelFormat::binary).num_points();
    }
    // The 2D points of images.bin are skipped
    const auto bytes = static_cast<std::int64_t>(file_size(folder / "points3D.bin"));
    state.SetBytesProcessed(state.iterations() * bytes);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points));
}

BENCHMARK(bench_read)->Apply(sample_sizes)->UseRealTime();

} // namespace
} // namespace vcarve::bench
