#pragma once

#include "steps/4_visibility/walk.h"
#include "vcarve/scene.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <vector>

namespace vcarve::bench {

/// How many facets all sights of a scene cross.
inline std::size_t walk_all_sights(const TetMesh& cells, const Scene& scene)
{
    std::vector<Sight> sights;
    for (Index vertex = 0; vertex < scene.num_points(); ++vertex) {
        for (const std::uint32_t view : scene.tracks[vertex]) {
            sights.push_back({vertex, scene.views[view].center});
        }
    }
    std::size_t crossings = 0;
    SightWalk(cells).along_each(
        sights.size(), [&](std::size_t k) { return sights[k]; },
        [&](std::size_t, Index, int) {
            ++crossings;
            return true;
        },
        [](std::size_t, const WalkEnds&) {});
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
