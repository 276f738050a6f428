#pragma once

#include "base/progress.h"
#include "texture/calibrated_photo.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

inline constexpr std::uint32_t kNoPhoto = 0xffffffffU; ///< of a face that none shows
inline constexpr std::uint32_t kNoFace = 0xffffffffU;  ///< beyond the border of the surface

/// Of each face those beside it across its edges, from its first corner to its second first;
/// kNoFace across an edge that has not two faces that run along it in opposite directions.
using FacesBeside = std::vector<std::array<std::uint32_t, 3>>;

FacesBeside find_faces_beside(const TriMesh& mesh);

/// The photograph that each face is covered with: the one that shows it largest, but for few long
/// seams. A face that is shown smaller than it could be costs the share that is lost of its pixels,
/// a seam costs its length; both are counted in squares of some pixels, so that the same surface
/// cut into smaller faces has the same seams. Minimised by expansion moves (Y. Boykov, O. Veksler
/// and R. Zabih, "Fast approximate energy minimization via graph cuts", PAMI 2001), each of which
/// is one minimum cut over the faces that a photograph shows. Cost: two rounds of one cut a
/// photograph.
std::vector<std::uint32_t> choose_photos(const TriMesh& mesh,
                                         const std::vector<CalibratedPhoto>& photos,
                                         const std::vector<PhotosOfFace>& photos_of_faces,
                                         const FacesBeside& beside, const Progress& progress);

} // namespace vcarve
