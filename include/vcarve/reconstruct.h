#pragma once

#include "vcarve/io.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/texture.h"
#include "vcarve/tri_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve {

/// A mesh and the filtered, centered scene it was made from.
struct Reconstruction {
    Scene scene;     ///< the points that passed the filter; TriMesh::points are indices of these
    TriMesh mesh;    ///< in the frame of `scene`: both have the same offset
    Texture texture; ///< without pages unless Options::texture selects it
    /// For MeshFormat::comments: program version, a digest of the input, options that differ from
    /// the defaults.
    std::vector<std::string> comments;
    Eigen::Vector3d up = Eigen::Vector3d::Zero(); ///< of most cameras, for MeshFormat::up
};

/// Reconstructs the surface of a scene: runs all steps, on `options.threads` threads. The result is
/// the same for any thread count. `log` receives every stage, and is polled for cancellation.
/// Dense points, masks and texture need the folder Options::images, because a scene does not know
/// the files of its photographs.
///
/// Throws UsageError before any work if an option is out of range (with its name, the found and the
/// accepted values), if the sizes of the scene's arrays disagree, or if photographs are needed and
/// no folder is given. Throws InputError before any work if the run would exceed
/// `options.memory.limit`, or no photograph can be used. Throws InputError later if the scene has
/// too little data for a surface, or the file of a region is wrong. Throws Cancelled
/// within a fraction of a second after Log::should_stop() returns true. Uses no globals, so runs
/// may be concurrent.
///
/// kAutoMemory means no limit here. Only the program measures free memory, and divides larger
/// models into tiles.
Reconstruction reconstruct(Scene input, const Options& options, Log& log);

/// Reads a model with read_model() and reconstructs it; the surface is the same. Points of a dense
/// cloud with a visibility file are merged while they are read, in the stage "read" (ThinOptions).
/// So memory never holds all of them. Photographs are those of Options::images, or in the folder
/// `images` beside the model. Throws the exceptions of both functions.
Reconstruction reconstruct(const std::filesystem::path& input, const PointsOptions& points,
                           const Options& options, Log& log);

} // namespace vcarve
