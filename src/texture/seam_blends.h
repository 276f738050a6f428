#pragma once

#include "texture/charts.h"
#include "texture/choose_photos.h"
#include "texture/face_photos.h"
#include "texture/seam_levels.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// How a photograph from beyond a seam shows through in a face.
struct Blend {
    std::uint32_t face;
    std::uint32_t photo;
    std::array<float, 3> far; ///< of its corners from the seam: 0 there, 1 where it ends
    std::array<Eigen::Array3f, 3> levels; ///< of its corners, added to the photograph's colours
};

/// The faces near seams, of each photograph those that it shows through, as far as it shows them:
/// on either side of a seam within so many texels, as distances along edges tell. Cost: O(vertices
/// near seams). Photographs after the last that shows through anywhere have no row.
std::vector<std::vector<Blend>> find_blends(const TriMesh& mesh,
                                            const std::vector<PhotosOfFace>& photos_of_faces,
                                            const std::vector<std::uint32_t>& photo_of_face,
                                            const Atlas& atlas, const CornerLevels& levels);

} // namespace vcarve
