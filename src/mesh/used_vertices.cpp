#include "mesh/used_vertices.h"

#include "base/parallel.h"

#include <atomic>

namespace vcarve {

std::vector<std::uint32_t> used_vertices(const std::vector<Face>& faces, std::size_t num_vertices)
{
    std::vector<char> used(num_vertices, 0);
    parallel_for(faces.size(), [&](std::size_t i) {
        for (const std::uint32_t vertex : faces[i]) {
            std::atomic_ref(used[vertex]).store(1, std::memory_order_relaxed);
        }
    });
    return parallel_collect<std::uint32_t>(num_vertices, [&](std::size_t vertex, auto& vertices) {
        if (used[vertex] != 0) vertices.push_back(static_cast<std::uint32_t>(vertex));
    });
}

void renumber(std::vector<Face>& faces, const std::vector<std::uint32_t>& used,
              std::size_t num_vertices)
{
    std::vector<std::uint32_t> numbers(num_vertices);
    parallel_for(used.size(),
                 [&](std::size_t i) { numbers[used[i]] = static_cast<std::uint32_t>(i); });
    parallel_for(faces.size(), [&](std::size_t i) {
        for (std::uint32_t& vertex : faces[i]) {
            vertex = numbers[vertex];
        }
    });
}

} // namespace vcarve
