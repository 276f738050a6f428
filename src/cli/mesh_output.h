#pragma once

#include "cli/mesh_arguments.h"
#include "pipeline/scene_run.h"
#include "run/digest.h"
#include "vcarve/log.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace vcarve::cli {

/// The frame of the mesh file.
struct OutputFrame {
    std::optional<Similarity> transform; ///< applied to the model first
    Eigen::Vector3d offset;              ///< then subtracted
    Eigen::Vector3d up;
};

/// The frame of the mesh file. Notes the up direction if the images leave it ambiguous.
OutputFrame frame_of(const Scene& model, const MeshArguments& arguments, Log& log);

/// comments_of() with the options of the output and the tiles.
std::vector<std::string> comments_of(const Digest& scene, const MeshArguments& arguments,
                                     const OutputFrame& frame, std::size_t tile_points);

/// Writes the mesh file, as the stage "write". Notes what differs from the model's frame. Throws
/// UsageError as write_mesh().
void write_surface(const MeshArguments& arguments, const Reconstruction& made,
                   const OutputFrame& frame, Log& log);

} // namespace vcarve::cli
