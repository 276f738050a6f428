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

/// The photographs of a scene's views, in the frame of a mesh. Views without a photograph or with
/// an unknown lens are left out.
std::vector<CalibratedPhoto> calibrated_photos(const Scene& scene, const Photographs& photographs,
                                               const Eigen::Vector3d& mesh_offset);

/// How a surface is covered with photographs.
struct TextureOptions {
    double scale = 1.0;      ///< texels a pixel of the photographs
    int most_page_px = 4096; ///< a page's longest side
    /// Where all pages together would have more texels, at 7 bytes each, they are made coarser, and
    /// a note says so.
    std::size_t most_texels = std::size_t{1} << 28U;
    std::size_t photos_at_a_time = 4; ///< in memory
    bool only_colors = false;         ///< vertices are coloured, no texture is made
};

/// A surface that is covered with photographs. Faces may have been halved where no photograph shows
/// all of one.
struct TexturedMesh {
    TriMesh mesh; ///< its vertices have the photographs' colours, too
    Texture texture;
    std::vector<std::int32_t> view_of_face; ///< index into Scene::views; -1 where none shows it
};

/// Covers a surface with photographs: finds which show which face, chooses one for each, lays out
/// charts, makes exposures agree and paints the pages (after M. Waechter, N. Moehrle and M.
/// Goesele, "Let there be color! Large-scale texturing of 3D reconstructions", ECCV 2014, and V.
/// Lempitsky and D. Ivanov, "Seamless mosaicing of image-based texture maps", CVPR 2007). Runs as
/// the stages "photos", "colors" and "texture" of `log`. The same result for any number of threads.
/// Photographs that cannot be read are left out with a note. Throws Cancelled. Cost: every
/// photograph is read twice, for colours alone once; `photos_at_a_time` are in memory.
TexturedMesh texture_mesh(TriMesh mesh, const std::vector<CalibratedPhoto>& photos,
                          const TextureOptions& options, Log& log);

} // namespace vcarve
