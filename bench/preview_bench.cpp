#include "picture/shade.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace vcarve::bench {
namespace {

/// A square of hills of about so many faces, before a camera that looks along z.
TriMesh hills(std::int64_t num_faces)
{
    const auto side = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(num_faces) / 2.0));
    TriMesh mesh;
    for (std::uint32_t row = 0; row <= side; ++row) {
        for (std::uint32_t column = 0; column <= side; ++column) {
            const double x = 8.0 * column / side - 4.0;
            const double y = 8.0 * row / side - 4.0;
            mesh.positions.emplace_back(x, y, 5.0 + 0.5 * std::sin(7.0 * x) * std::sin(9.0 * y));
            mesh.colors.push_back({200, static_cast<std::uint8_t>(column % 256), 90});
            if (row == side || column == side) continue;
            const std::uint32_t a = row * (side + 1) + column;
            const std::uint32_t below = a + side + 1;
            mesh.faces.push_back({a, below, a + 1});
            mesh.faces.push_back({a + 1, below, below + 1});
        }
    }
    return mesh;
}

/// Both views of 1280 x 960 pixels, through a lens with distortion or without.
void bench_look_at(benchmark::State& state)
{
    const TriMesh mesh = hills(state.range(0));
    Eye eye;
    eye.camera = {.id = 1,
                  .model = 4,
                  .width_px = 4000,
                  .height_px = 3000,
                  .params = {3000, 3000, 2000, 1500, -0.1, 0.02, 0.001, 0.001}};
    if (state.range(1) == 0) eye.camera.params.resize(4);
    if (state.range(1) == 0) eye.camera.model = 1;
    for (auto _ : state) {
        benchmark::DoNotOptimize(look_at(mesh, {}, eye, 1280.0 * 960.0));
    }
}

BENCHMARK(bench_look_at)
    ->ArgNames({"faces", "distorted"})
    ->ArgsProduct({{1'000'000}, {0, 1}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

} // namespace
} // namespace vcarve::bench
