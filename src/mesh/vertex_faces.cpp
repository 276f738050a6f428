#include "mesh/vertex_faces.h"

namespace vcarve {

VertexFaces::VertexFaces(std::span<const Face> faces, std::size_t num_vertices,
                         const FaceFlags& flags)
    : table_(gather_rows(faces.size(), num_vertices, [&](std::size_t face, const auto& visit) {
          if (!flags.empty() && flags[face] == 0) return;
          for (const std::uint32_t vertex : faces[face]) {
              visit(vertex, static_cast<std::uint32_t>(face));
          }
      }))
{
}

} // namespace vcarve
