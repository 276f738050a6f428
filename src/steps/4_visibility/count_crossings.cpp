#include "steps/4_visibility/count_crossings.h"

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

/// The rays to a run of vertices.
std::vector<Sight> rays_to(Index first, Index last, const RaySource& source)
{
    const Tracks& rays = *source.rays;
    std::vector<Sight> sights;
    sights.reserve(rays.begins[last] - rays.begins[first]);
    for (Index vertex = first; vertex < last; ++vertex) {
        for (const std::uint32_t origin : rays[vertex]) {
            sights.push_back({vertex, source.origins[origin]});
        }
    }
    return sights;
}

} // namespace

Crossings CrossingCounter::said_of(const RaySource& source, const VertexRun& points,
                                   const Progress& progress) const
{
    Crossings crossings(cells_.cells.size(), {0, 0, 0, 0});
    for_each_run_of_vertices(points, progress, [&](Index first, Index last) {
        const std::vector<Sight> sights = rays_to(first, last, source);
        SightWalk(cells_).along_each(
            sights.size(), [&](std::size_t k) { return sights[k]; },
            [&](std::size_t, Index cell, int slot) { // counted on both sides
                const Index beyond = cells_.cells[cell].neighbors[slot];
                count_one(crossings[cell][slot]);
                count_one(crossings[beyond][cells_.mirror(cell, slot)]);
                return true;
            },
            [](std::size_t, const WalkEnds&) {});
    });
    return crossings;
}

CrossingCounter::Share CrossingCounter::share(const RaySource& source, const VertexRun& points,
                                              const Progress& progress) const
{
    return sparse_sums(said_of(source, points, progress));
}

void CrossingCounter::add(const Share& share, Crossings& said) const
{
    add_sparse(share, said, [](auto& sums, const auto& others) {
        for (int slot = 0; slot < 4; ++slot) {
            sums[slot] += others[slot];
        }
    });
}

void CrossingCounter::finish(const RaySource& source, const Crossings& said,
                             Crossings& crossings) const
{
    crossings.resize(cells_.cells.size(), {0, 0, 0, 0});
    parallel_for(said.size(), [&](std::size_t cell) {
        for (int slot = 0; slot < 4; ++slot) {
            crossings[cell][slot] += static_cast<std::uint32_t>(source.weight * said[cell][slot]);
        }
    });
}

void CrossingCounter::cast(const RaySource& source, Crossings& crossings,
                           const Progress& progress) const
{
    finish(source, said_of(source, all_vertices(cells_), progress), crossings);
}

} // namespace vcarve
