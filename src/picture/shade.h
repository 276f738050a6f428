#pragma once

#include "model/photograph.h"
#include "picture/eye.h"
#include "picture/picture.h"
#include "vcarve/tri_mesh.h"

namespace vcarve {

/// The colors of special pixels, 0 to 255.
inline const Eigen::Array3f kNothing{236.0F, 239.0F, 243.0F};   ///< no face
inline const Eigen::Array3f kNoRay{206.0F, 210.0F, 216.0F};     ///< the lens has no direction
inline const Eigen::Array3f kBack{255.0F, 0.0F, 255.0F};        ///< the back of a face
inline const Eigen::Array3f kUncolored{200.0F, 200.0F, 205.0F}; ///< the mesh has no colors

/// Two pictures of a mesh from one viewpoint.
struct Looks {
    Picture shaded;  ///< texture, or vertex colors lit from the eye
    Picture normals; ///< face normals: red is right, green up, blue toward the eye
};

/// Draws a mesh. Both pictures have the size picture_size(). Each pixel is the mean of four rays of
/// LensRays. Back faces are kBack in both. The mesh, with its offset, and the eye are in one frame.
/// An empty texture counts as none. Textures are not lit, because photographs include lighting. The
/// bytes do not depend on the thread count. Cost: FirstFaces with four rays per pixel, in parallel.
Looks look_at(const TriMesh& mesh, const Texture& texture, const Eye& eye, double most_pixels);

} // namespace vcarve
