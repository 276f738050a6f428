#pragma once

#include "texture/face_colors.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// Colors vertices from the photographs of their faces. Averages each photograph over the faces at
/// the vertex; each channel is the mean of the photographs near the median. A vertex without
/// photographs gets the mean color of its neighbors, ring by ring. Connected components without
/// photographs keep their colors, or become gray. Returns the number of vertices with photographs.
/// Cost: O(faces).
std::size_t color_vertices(const std::vector<PhotosOfFace>& photos_of_faces,
                           const FaceColors& colors, const Gains& gains, TriMesh& mesh);

} // namespace vcarve
