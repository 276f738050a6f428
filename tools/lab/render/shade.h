#pragma once

#include "render/picture.h"
#include "render/raster.h"
#include "vcarve/tri_mesh.h"

namespace vcarve::render {

struct ShadeOptions {
    bool use_colors = true; ///< the mesh's vertex colours, where it has them; grey otherwise
    bool draw_edges = false;
};

/// A picture of a mesh lit from the camera: fronts in their colours, backs in magenta, white where
/// there is nothing. Nine samples a pixel.
Picture shade(const TriMesh& mesh, const Pinhole& view, const ShadeOptions& options);

/// A view of the whole mesh from a direction (mesh to camera), with `up` upwards, 45 degrees high.
struct Look {
    Eigen::Vector3d from;
    Eigen::Vector3d up;
};
Pinhole view_of_whole(const TriMesh& mesh, const Look& look, int width_px);

} // namespace vcarve::render
