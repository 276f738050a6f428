#include "mesh/vertex_faces.h"

#include <numeric>

namespace vcarve {

VertexFaces::VertexFaces(std::span<const Face> faces, std::size_t num_vertices,
                         const FaceFlags& flags)
    : ends_(num_vertices, 0)
{
    // A counting sort: hardly slower than what would need atomics to be parallel.
    const auto for_each_corner = [&](const auto& visit) {
        for (std::uint32_t face = 0; face < faces.size(); ++face) {
            if (!flags.empty() && flags[face] == 0) continue;
            for (const std::uint32_t vertex : faces[face]) {
                visit(vertex, face);
            }
        }
    };
    for_each_corner([&](std::uint32_t vertex, std::uint32_t) { ++ends_[vertex]; });
    const std::uint32_t total = std::accumulate(ends_.begin(), ends_.end(), 0U);
    std::exclusive_scan(ends_.begin(), ends_.end(), ends_.begin(), 0U);
    faces_.resize(total);
    for_each_corner(
        [&](std::uint32_t vertex, std::uint32_t face) { faces_[ends_[vertex]++] = face; });
}

} // namespace vcarve
