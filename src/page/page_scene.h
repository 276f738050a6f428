#pragma once

#include "base/progress.h"
#include "model/photograph.h"
#include "steps/6_surface/carve_surface.h"
#include "stereo/depth_picture.h"
#include "vcarve/scene.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>

namespace vcarve {

/// Limits of a run's page, so that it opens at once and stays below 8 MB.
struct PageLimits {
    std::int64_t faces = 200'000;   ///< of a surface; larger surfaces are simplified
    std::size_t points = 100'000;   ///< evenly chosen if there are more
    std::size_t views = 2'000;      ///< evenly chosen if there are more
    std::size_t removed = 40'000;   ///< removed faces; the largest if there are more
    std::size_t texels = 6'000'000; ///< of a texture; larger textures are scaled down
};

/// The JSON array [x, y, z].
nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector);

/// A mesh for the page's script: "positions", "faces" and "colors" as in pack.h, and "of", the
/// number of faces before simplification.
nlohmann::ordered_json packed_mesh(const TriMesh& mesh, std::size_t of);

/// packed_mesh() of a surface, with the number of views and the error of each vertex, and the
/// support of each face. `mesh` needs TriMesh::points, which refer to `scene`.
nlohmann::ordered_json packed_surface(const TriMesh& mesh, const Scene& scene,
                                      const PageLimits& limits = {}, const Progress& progress = {});

/// A texture for the page's script. "pages" are JPEG files in base64. "places" has two 16-bit
/// little-endian numbers per corner of each face; 65535 is the right or lower edge of the page.
/// "page" has the page of each face. Null if there is no texture.
nlohmann::ordered_json packed_texture(const Texture& texture, const PageLimits& limits = {});

/// A depth map and its photograph for the page's script: "photograph" and "depth" are JPEG files in
/// base64, "name" is the name of the view. Null if there is no depth map.
nlohmann::ordered_json packed_depth(const DepthPicture& picture, const Scene& scene);

/// The points of a scene, its views as frusta, the up direction (up_of()) and "start". This is the
/// view that sees most of the observed region (seen_places()), with the median depth of its points,
/// or null if there is no view.
nlohmann::ordered_json packed_scene(const Scene& scene, const PageLimits& limits = {});

/// The removed faces in their order, only the largest if there are too many: positions, faces, and
/// the number of the reason of each face. Also the reasons that occur, in order, each with its name
/// and its total number of removed faces.
nlohmann::ordered_json packed_removed(const RemovedFaces& removed, const PageLimits& limits = {});

} // namespace vcarve
