#pragma once

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
/// Eigen's sparse Cholesky factors. Cost: that of factors of a matrix of a row a vertex.
CornerLevels level_seams(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
                         const FaceColors& colors, const Gains& gains,
                         const std::vector<std::uint32_t>& photo_of_face);

/// The place of a photograph in the list of those that show a face; -1 where it is not in it.
int place_of(const PhotosOfFace& photos, std::uint32_t photo);

} // namespace vcarve
