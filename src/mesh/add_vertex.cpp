#include "mesh/add_vertex.h"

#include <Eigen/Core>

namespace vcarve {

std::uint32_t add_copy(TriMesh& mesh, std::uint32_t original)
{
    const auto copy = static_cast<std::uint32_t>(mesh.positions.size());
    mesh.positions.push_back(Eigen::Vector3d(mesh.positions[original]));
    if (!mesh.colors.empty()) mesh.colors.push_back(Color(mesh.colors[original]));
    if (!mesh.points.empty()) mesh.points.push_back(std::uint32_t(mesh.points[original]));
    return copy;
}

std::uint32_t add_midpoint(TriMesh& mesh, std::uint32_t a, std::uint32_t b)
{
    const std::uint32_t middle = add_copy(mesh, a);
    mesh.positions[middle] = mesh.positions[a] + (mesh.positions[b] - mesh.positions[a]) / 2;
    for (std::size_t i = 0; i < 3 && !mesh.colors.empty(); ++i) {
        mesh.colors[middle][i] =
            static_cast<std::uint8_t>((mesh.colors[a][i] + mesh.colors[b][i] + 1) / 2);
    }
    if (!mesh.points.empty()) mesh.points[middle] = kNoPoint;
    return middle;
}

} // namespace vcarve
