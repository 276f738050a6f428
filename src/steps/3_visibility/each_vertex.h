#pragma once

#include "base/log.h"
#include "base/parallel.h"
#include "model/tet_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace vcarve {

/// Calls body(first, last) for runs of vertices [first, last) in parallel, which together are all,
/// and tells the stage how far it is.
template <typename Body>
void for_each_run_of_vertices(const TetMesh& cells, Stage& stage, const Body& body)
{
    constexpr std::size_t kRun = 512;
    const std::size_t count = cells.positions.size();
    std::atomic<std::size_t> done = 0;
    parallel_for((count + kRun - 1) / kRun,
                 [&](std::size_t run) {
                     body(static_cast<Index>(run * kRun),
                          static_cast<Index>(std::min(count, (run + 1) * kRun)));
                     done += kRun;
                     stage.progress(
                         std::min(1.0, static_cast<double>(done) / static_cast<double>(count)));
                 },
                 1);
}

/// Calls body(vertex) for every vertex in parallel and tells the stage how far it is.
template <typename Body>
void for_each_vertex(const TetMesh& cells, Stage& stage, const Body& body)
{
    for_each_run_of_vertices(cells, stage, [&](Index first, Index last) {
        for (Index vertex = first; vertex < last; ++vertex) {
            body(vertex);
        }
    });
}

} // namespace vcarve
