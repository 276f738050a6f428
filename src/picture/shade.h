#pragma once

#include "model/photograph.h"
#include "picture/eye.h"
#include "picture/picture.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// What a place of a picture shows, 0 to 255.
inline const Eigen::Array3f kNothing{236.0F, 239.0F, 243.0F};   ///< no face
inline const Eigen::Array3f kNoRay{206.0F, 210.0F, 216.0F};     ///< no direction of the lens
inline const Eigen::Array3f kBack{255.0F, 0.0F, 255.0F};        ///< the back of a face
inline const Eigen::Array3f kUncolored{200.0F, 200.0F, 205.0F}; ///< of meshes without colours

/// A mesh as an eye sees it, twice.
struct Looks {
    Picture shaded;  ///< in its texture, or in its vertex colours, lit from the eye
    Picture normals; ///< of the faces: red grows to the right, green upwards, blue towards the eye
};

/// Both pictures have picture_size(). Each pixel is the mean of four rays through the lens, as
/// LensRays has them. Backs of faces are kBack in both. The mesh and the eye are given in one
/// frame, apart from the mesh's offset. The bytes do not depend on the number of threads. Cost:
/// that of FirstFaces, four rays a pixel in parallel. A texture without pages is none; one with
/// pages has the light of its photographs, and gets no other.
Looks look_at(const TriMesh& mesh, const Texture& texture, const Eye& eye, double most_pixels);

} // namespace vcarve
