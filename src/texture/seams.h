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

/// The offset added to the color at each corner of each face with a photograph, in levels of 255.
using CornerLevels = std::vector<std::array<Eigen::Array3f, 3>>;

/// Computes offsets that make photographs agree at seams. Photographs that meet at a vertex get
/// equal colors there, and the offsets of a photograph vary little between neighboring vertices (V.
/// Lempitsky and D. Ivanov, "Seamless mosaicing of image-based texture maps", CVPR 2007). Solves
/// the least squares by a sparse Cholesky factorization. Returns zeros if there is no finite
/// solution. Cost: one factorization of a matrix with a row per vertex and photograph.
CornerLevels level_seams(const TriMesh& mesh, const std::vector<PhotosOfFace>& photos_of_faces,
                         const FaceColors& colors, const Gains& gains,
                         const std::vector<std::uint32_t>& photo_of_face);

/// Returns the index of a photograph in the list of a face, or -1.
int place_of(const PhotosOfFace& photos, std::uint32_t photo);

/// A photograph from beyond a seam that is blended into a face.
struct Blend {
    std::uint32_t face;
    std::uint32_t photo;
    std::array<float, 3> far;             ///< corners' distances to the seam; 1: no blending
    std::array<Eigen::Array3f, 3> levels; ///< offsets of the photograph's colors at corners
};

/// Finds, for each photograph, the faces of other photographs that it is blended into. It must show
/// them, and they lie within 16 texels of a seam, measured along edges. The result has no rows
/// after the last photograph with blends. Cost: O(vertices near seams).
std::vector<std::vector<Blend>> find_blends(const TriMesh& mesh,
                                            const std::vector<PhotosOfFace>& photos_of_faces,
                                            const std::vector<std::uint32_t>& photo_of_face,
                                            const Atlas& atlas, const CornerLevels& levels);

} // namespace vcarve
