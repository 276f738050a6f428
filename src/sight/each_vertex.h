#pragma once

#include "base/log.h"
#include "base/parallel.h"
#include "model/tet_mesh.h"

#include <algorithm>
#include <atomic>
#include <cstddef>

namespace vcarve {

/// Calls body(vertex) for every vertex in parallel and tells the stage how far it is.
template <typename Body>
void for_each_vertex(const TetMesh& cells, Stage& stage, const Body& body)
{
    constexpr std::size_t kBlock = 512;
    const std::size_t count = cells.positions.size();
    std::atomic<std::size_t> done = 0;
    parallel_for((count + kBlock - 1) / kBlock,
                 [&](std::size_t block) {
                     const std::size_t end = std::min(count, (block + 1) * kBlock);
                     for (std::size_t vertex = block * kBlock; vertex < end; ++vertex) {
                         body(static_cast<Index>(vertex));
                     }
                     done += kBlock;
                     stage.progress(
                         std::min(1.0, static_cast<double>(done) / static_cast<double>(count)));
                 },
                 1);
}

} // namespace vcarve
