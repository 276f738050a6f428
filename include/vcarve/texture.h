#pragma once

#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace vcarve {

/// A photograph or another image: rows from the top, three bytes per pixel, red first.
struct Photograph {
    int width_px = 0;                     ///< number of columns
    int height_px = 0;                    ///< number of rows
    std::vector<std::uint8_t> rgb;        ///< three bytes per pixel
    std::vector<std::uint8_t> alpha = {}; ///< per pixel, 0 if transparent; empty if none is
};

/// The images that cover a surface, and the position of each face in them.
struct Texture {
    std::vector<Photograph> pages;           ///< images
    std::vector<std::uint32_t> page_of_face; ///< parallel to the faces of the mesh
    /// The positions of each face's corners in its page: (0, 0) is the upper left corner of the
    /// page, (1, 1) the lower right corner.
    std::vector<std::array<Eigen::Vector2f, 3>> places;

    /// Whether there is no texture.
    bool is_empty() const { return pages.empty(); }
};

/// A textured mesh. Its faces may be parts of the input's.
struct TexturedMesh {
    TriMesh mesh;                                 ///< vertices have the photographs' colors, too
    Texture texture;                              ///< one position per corner of a face
    Eigen::Vector3d up = Eigen::Vector3d::Zero(); ///< of most cameras, for MeshFormat::up
};

/// Textures a mesh with the photographs of a scene's views, which are in Options::images. The mesh
/// is in the frame of the scene, and need not be manifold. Faces that no photograph shows
/// completely may be bisected, which does not change the shape. Of the options, the photographs,
/// masks, texture, threads and memory count.
///
/// Throws UsageError if an option is out of range or no folder is given. Throws InputError if no
/// photograph can be used, and Cancelled. Cost: reads every photograph twice.
TexturedMesh texture(const Scene& model, TriMesh mesh, Options options, Log& log);

/// Reads the sparse points and views of a model like read_model(), and textures a mesh. Photographs
/// are those of Options::images, or in the folder `images` beside the model.
TexturedMesh texture(const std::filesystem::path& model, TriMesh mesh, Options options, Log& log);

} // namespace vcarve
