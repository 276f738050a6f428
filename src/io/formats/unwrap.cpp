#include "io/formats/unwrap.h"

#include <algorithm>
#include <cstdint>
#include <map>
#include <tuple>

namespace vcarve {

UnwrappedMesh unwrap(const TriMesh& mesh, const Texture& texture)
{
    UnwrappedMesh unwrapped;
    unwrapped.mesh.offset = mesh.offset;
    for (std::uint32_t page = 0; page < texture.pages.size(); ++page) {
        std::map<std::tuple<std::uint32_t, float, float>, std::uint32_t> vertices;
        for (std::size_t face = 0; face < mesh.faces.size(); ++face) {
            if (texture.page_of_face[face] != page) continue;
            Face& added = unwrapped.mesh.faces.emplace_back();
            for (int i = 0; i < 3; ++i) {
                const std::uint32_t vertex = mesh.faces[face][i];
                const Eigen::Vector2f& place = texture.places[face][i];
                const auto number = static_cast<std::uint32_t>(unwrapped.places.size());
                const auto [found, is_new] =
                    vertices.try_emplace({vertex, place.x(), place.y()}, number);
                added[i] = found->second;
                if (!is_new) continue;
                unwrapped.places.push_back(place);
                unwrapped.mesh.positions.push_back(mesh.positions[vertex]);
                if (!mesh.normals.empty()) unwrapped.mesh.normals.push_back(mesh.normals[vertex]);
            }
        }
        unwrapped.begins.push_back(unwrapped.mesh.faces.size());
    }
    return unwrapped;
}

} // namespace vcarve
