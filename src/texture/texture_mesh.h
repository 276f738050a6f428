#pragma once

#include "base/progress.h"
#include "io/images/calibrated_photo.h"
#include "texture/face_colors.h"
#include "texture/face_photos.h"
#include "vcarve/options.h"
#include "vcarve/texture.h"
#include "vcarve/tri_mesh.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace vcarve {

/// Limits of texturing.
struct TextureLimits {
    double scale = 1.0;      ///< texels per photograph pixel, along a side
    int most_page_px = 4096; ///< maximum side of a page
    /// Maximum texels of all pages, at 7 bytes each. If more are needed, `scale` is reduced, with a
    /// note.
    std::size_t most_texels = std::size_t{1} << 28U;
    std::size_t photos_at_a_time = 4; ///< photographs in memory at once
};

inline constexpr double kPhotoPixelBytes = 8; ///< memory of a photograph with its pyramid, decoding
inline constexpr double kTexelBytes = 7;      ///< memory of a page

/// The limits within Options::memory: a quarter of it is for the pages, half for photographs, the
/// rest for the mesh.
TextureLimits texture_limits(const Options& options, std::span<const PhotographSize> photos);

/// A mesh and its photographs, which the three steps of texturing complete (after M. Waechter, N.
/// Moehrle and M. Goesele, "Let there be color! Large-scale texturing of 3D reconstructions", ECCV
/// 2014, and V. Lempitsky and D. Ivanov, "Seamless mosaicing of image-based texture maps", CVPR
/// 2007). find_photos_of_faces() is the first step. All are the same for any thread count.
struct MeshPhotos {
    std::vector<PhotosOfFace> of_faces;  ///< by find_photos_of_faces()
    FaceColors colors{};                 ///< by color_mesh()
    Gains gains{};                       ///< by color_mesh(): exposures
    std::vector<std::string> problems{}; ///< by color_mesh(): a sentence per unreadable photograph
};

/// Counts of color_mesh().
struct ColoredVertices {
    std::size_t vertices = 0; ///< vertices that photographs show
    std::size_t outliers = 0; ///< photographs of faces dropped as occluded
};

/// Colors the vertices of a mesh, after equalizing exposures. Reads every photograph once. Skips
/// unreadable photographs. Throws Cancelled.
ColoredVertices color_mesh(TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                           std::size_t photos_at_a_time, MeshPhotos& shown,
                           const Progress& progress);

/// The texture of a mesh.
struct PaintedTexture {
    Texture texture;
    std::vector<std::int32_t> view_of_face; ///< index into Scene::views; -1: not visible
    std::size_t charts = 0;
    double scale = 1.0; ///< texels per photograph pixel; less than requested to limit memory
};

/// Chooses one photograph for each face, lays out charts, levels seams and paints the pages, after
/// color_mesh(). Reads every photograph once more. Throws Cancelled.
PaintedTexture paint_texture(const TriMesh& mesh, const std::vector<CalibratedPhoto>& photos,
                             const MeshPhotos& shown, const TextureLimits& limits,
                             const Progress& progress);

} // namespace vcarve
