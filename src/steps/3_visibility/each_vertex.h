#pragma once

#include "base/parallel.h"
#include "model/tet_mesh.h"

#include <algorithm>
#include <cstddef>

namespace vcarve {

/// Calls body(first, last) for runs of vertices [first, last) in parallel, which together are all,
/// and tells how far it is.
template <typename Body>
void for_each_run_of_vertices(const TetMesh& cells, const Progress& progress, const Body& body)
{
    constexpr std::size_t kRun = 512;
    const std::size_t count = cells.positions.size();
    parallel_for((count + kRun - 1) / kRun, progress,
                 [&](std::size_t run) {
                     body(static_cast<Index>(run * kRun),
                          static_cast<Index>(std::min(count, (run + 1) * kRun)));
                 },
                 1);
}

/// Calls body(vertex) for every vertex in parallel and tells how far it is.
template <typename Body>
void for_each_vertex(const TetMesh& cells, const Progress& progress, const Body& body)
{
    for_each_run_of_vertices(cells, progress, [&](Index first, Index last) {
        for (Index vertex = first; vertex < last; ++vertex) {
            body(vertex);
        }
    });
}

} // namespace vcarve
