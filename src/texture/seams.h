#pragma once

#include "texture/charts.h"
#include "texture/choose_photos.h"
#include "texture/face_colors.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Of each corner of each face that a photograph covers, what is added there to its colour, in
/// levels of 255.
using CornerLevels = std::vector<std::array<Eigen::Array3f, 3>>;

/// What makes photographs agree where they meet: at a vertex where several do, their colours are to
/// be the same after it, and from vertex to vertex of a photograph it changes little (V. Lempitsky
/// and D. Ivanov, "Seamless mosaicing of image-based texture maps", CVPR 2007). Least squares, by
/// Eigen's sparse Cholesky factors. All zero if they have no finite solution. Cost: that of factors
/// of a matrix of a row a vertex.
CornerLevels level_seams(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
                         const FaceColors& colors, const Gains& gains,
                         const std::vector<std::uint32_t>& photo_of_face);

/// The place of a photograph in the list of those that show a face; -1 where it is not in it.
int place_of(const PhotosOfFace& photos, std::uint32_t photo);

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
