#pragma once

#include "model/scene.h"
#include "sight/walk.h"

#include <benchmark/benchmark.h>

#include <cstddef>

namespace vcarve::bench {

/// How many facets all sights of a scene cross, walked one after another.
inline std::size_t walk_all_sights(const TetMesh& cells, const Scene& scene)
{
    std::size_t crossings = 0;
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        SightWalk walk(cells, vertex);
        for (const std::uint32_t view : scene.tracks[vertex]) {
            walk.to(scene.views[view].center, [&](Index, int) { ++crossings; });
        }
    }
    return crossings;
}

inline void report_crossings(benchmark::State& state, std::size_t crossings)
{
    state.counters["crossings"] = static_cast<double>(crossings);
    state.counters["CPU_s_a_crossing"] = benchmark::Counter(
        static_cast<double>(crossings),
        benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

} // namespace vcarve::bench
