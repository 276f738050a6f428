#pragma once

#include "texture/face_colors.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <vector>

namespace vcarve {

/// Gives vertices the colours that photographs show around them: of each channel the mean over
/// those photographs that are near the median of all, each averaged over the faces at the vertex.
/// A vertex that none shows gets the mean colour of those beside it, and so on from vertex to
/// vertex; pieces that no photograph shows keep the colours they have, or become grey. Returns how
/// many vertices photographs show. Cost: O(faces).
std::size_t color_vertices(const std::vector<PhotosOfFace>& photos_of_faces,
                           const FaceColors& colors, const Gains& gains, TriMesh& mesh);

} // namespace vcarve
