#pragma once

#include "base/parallel.h"
#include "model/tet_mesh.h"

#include <algorithm>
#include <cstddef>

namespace vcarve {

/// The vertices from `first` up to `last`, and without that.
struct VertexRun {
    Index first = 0;
    Index last = 0;
};

inline VertexRun all_vertices(const TetMesh& cells)
{
    return {0, static_cast<Index>(cells.positions.size())};
}

/// Calls body(first, last) for shorter runs of vertices [first, last) in parallel, which together
/// are `all`, and tells how far it is.
template <typename Body>
void for_each_run_of_vertices(const VertexRun& all, const Progress& progress, const Body& body)
{
    constexpr std::size_t kRun = 512;
    const std::size_t count = all.last - all.first;
    parallel_for((count + kRun - 1) / kRun, progress,
                 [&](std::size_t run) {
                     body(all.first + static_cast<Index>(run * kRun),
                          all.first + static_cast<Index>(std::min(count, (run + 1) * kRun)));
                 },
                 1);
}

/// Calls body(vertex) for every vertex in parallel and tells how far it is.
template <typename Body>
void for_each_vertex(const TetMesh& cells, const Progress& progress, const Body& body)
{
    for_each_run_of_vertices(all_vertices(cells), progress, [&](Index first, Index last) {
        for (Index vertex = first; vertex < last; ++vertex) {
            body(vertex);
        }
    });
}

} // namespace vcarve
