#include "steps/4_visibility/count_crossings.h"

#include "base/parallel.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/walk.h"

#include <atomic>
#include <cstddef>
#include <vector>

namespace vcarve {

namespace {

void count_one(std::uint32_t& count)
{
    std::atomic_ref<std::uint32_t>(count).fetch_add(1, std::memory_order_relaxed);
}

/// The rays to the vertices [first, last).
std::vector<Ray> rays_to(Index first, Index last, const RaySource& source)
{
    const Tracks& tracks = *source.rays;
    std::vector<Ray> rays;
    rays.reserve(tracks.begins[last] - tracks.begins[first]);
    for (Index vertex = first; vertex < last; ++vertex) {
        for (const std::uint32_t origin : tracks[vertex]) {
            rays.push_back({vertex, source.origins[origin]});
        }
    }
    return rays;
}

/// The number of rays that cross each facet.
Crossings count(const TetMesh& cells, const RaySource& source, const Progress& progress)
{
    Crossings crossings(cells.cells.size(), {0, 0, 0, 0});
    for_each_run_of_vertices(cells, progress, [&](Index first, Index last) {
        const std::vector<Ray> rays = rays_to(first, last, source);
        RayWalk(cells).along_each(
            rays.size(), [&](std::size_t k) { return rays[k]; },
            [&](std::size_t, Index cell, int slot) { // counted on both sides
                const Index beyond = cells.cells[cell].neighbors[slot];
                count_one(crossings[cell][slot]);
                count_one(crossings[beyond][cells.mirror(cell, slot)]);
                return true;
            },
            [](std::size_t, const WalkEnds&) {});
    });
    return crossings;
}

} // namespace

void CrossingCounter::cast(const RaySource& source, Crossings& crossings,
                           const Progress& progress) const
{
    const Crossings added = count(cells_, source, progress);
    crossings.resize(cells_.cells.size(), {0, 0, 0, 0});
    parallel_for(added.size(), [&](std::size_t cell) {
        for (int slot = 0; slot < 4; ++slot) {
            crossings[cell][slot] += static_cast<std::uint32_t>(source.weight * added[cell][slot]);
        }
    });
}

} // namespace vcarve
