#pragma once

#include "stereo/stereo_view.h"
#include "vcarve/tri_mesh.h"

#include <span>
#include <vector>

namespace vcarve {

/// What a view shows of a mesh, per pixel of its image.
struct MeshDepth {
    std::vector<float> depth; ///< z of the first face; infinite if there is none
    std::vector<float> step;  ///< change of z if all faces move by their step; empty without steps
};

/// The least cosine between a normal and the direction to the camera that counts as visible.
inline constexpr float kLeastCosine = 0.25F;

/// Rasterizes a mesh into the depth map of a view. Both sides of a face are drawn, and faces that
/// reach behind the camera are left out. `steps` are distances along the normal, one per vertex, or
/// none. Cost: O(faces + covered pixels).
MeshDepth mesh_depth(const TriMesh& mesh, const StereoView& view, std::span<const float> steps);

/// The position of a pixel, and its depth.
struct PixelDepth {
    float x = 0.0F;
    float y = 0.0F;
    float z = 0.0F; ///< not positive if the camera does not see the position
};

PixelDepth pixel_depth(const StereoView& view, const Eigen::Vector3d& position);

} // namespace vcarve
