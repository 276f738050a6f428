#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "texture/face_photos.h"
#include "vcarve/tri_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

inline constexpr std::uint32_t kNoPhoto = 0xffffffffU; ///< no photograph shows the face
inline constexpr std::uint32_t kNoFace = 0xffffffffU;  ///< no neighbor across the edge

/// The neighbors of each face across its edges; the first edge joins the first and second corner.
/// kNoFace if an edge does not have exactly two faces, with opposite directions.
using FacesBeside = std::vector<std::array<std::uint32_t, 3>>;

FacesBeside find_faces_beside(const TriMesh& mesh);

/// Chooses a photograph for each face: one that shows it large, with short seams. A face costs the
/// pixels that it loses against its largest photograph, a seam its length. Both are measured in
/// squares of 40 pixels, so splitting faces does not change the seams. The cost is minimized by
/// expansion moves (Y. Boykov, O. Veksler and R. Zabih, "Fast approximate energy minimization via
/// graph cuts", PAMI 2001). A move is one minimum cut over the faces that a photograph shows. Cost:
/// at most two rounds of one cut per photograph.
std::vector<std::uint32_t> choose_photos(const TriMesh& mesh,
                                         const std::vector<CalibratedPhoto>& photos,
                                         const std::vector<PhotosOfFace>& photos_of_faces,
                                         const FacesBeside& beside, const Progress& progress);

} // namespace vcarve
