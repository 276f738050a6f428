#pragma once

#include "io/images/find_photographs.h"
#include "model/photograph.h"
#include "texture/calibrated_photo.h"
#include "vcarve/log.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Returns the photographs of a scene's views, in the frame of a mesh. Skips views without a
/// photograph or with an unknown lens.
std::vector<CalibratedPhoto> calibrated_photos(const Scene& scene, const Photographs& photographs,
                                               const Eigen::Vector3d& mesh_offset);

/// Options of texture_mesh().
struct TextureOptions {
    double scale = 1.0;      ///< texels per photograph pixel, along a side
    int most_page_px = 4096; ///< maximum side of a page
    /// Maximum texels of all pages, at 7 bytes each. If more are needed, `scale` is reduced, with a
    /// note.
    std::size_t most_texels = std::size_t{1} << 28U;
    std::size_t photos_at_a_time = 4; ///< photographs in memory at once
    bool only_colors = false;         ///< color the vertices, make no texture
};

/// A textured surface. Its faces may be parts of the input's, see find_photos_of_faces().
struct TexturedMesh {
    TriMesh mesh; ///< vertices have the photographs' colors, too
    Texture texture;
    std::vector<std::int32_t> view_of_face; ///< index into Scene::views; -1: not visible
};

/// Textures a surface: finds the photographs of each face, chooses one, lays out charts, equalizes
/// exposures and paints the pages (after M. Waechter, N. Moehrle and M. Goesele, "Let there be
/// color! Large-scale texturing of 3D reconstructions", ECCV 2014, and V. Lempitsky and D. Ivanov,
/// "Seamless mosaicing of image-based texture maps", CVPR 2007). Reports the stages "photos",
/// "colors" and "texture" to `log`. The result is the same for any thread count. Unreadable
/// photographs are skipped with a note. Throws Cancelled. Cost: reads every photograph twice, for
/// colors alone once; `photos_at_a_time` are in memory.
TexturedMesh texture_mesh(TriMesh mesh, const std::vector<CalibratedPhoto>& photos,
                          const TextureOptions& options, Log& log);

} // namespace vcarve
