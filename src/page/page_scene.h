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

/// How much of a run a page holds, so that it opens at once and stays below 8 MB.
struct PageLimits {
    std::int64_t faces = 200'000;   ///< of a surface; larger ones are simplified
    std::size_t points = 100'000;   ///< evenly chosen of more
    std::size_t views = 2'000;      ///< evenly chosen of more
    std::size_t removed = 40'000;   ///< faces that were taken away: the largest of more
    std::size_t texels = 6'000'000; ///< of a texture; a larger one is made smaller
};

/// [x, y, z].
nlohmann::ordered_json vector_json(const Eigen::Vector3d& vector);

/// A mesh as the page's script reads it: "positions", "faces" and "colors" as pack.h has them, and
/// "of", the number of faces before it was simplified.
nlohmann::ordered_json packed_mesh(const TriMesh& mesh, std::size_t of);

/// packed_mesh() of a surface, per vertex the number of views and the error, and per face the
/// support. `mesh` needs TriMesh::points, which count the points of `scene`.
nlohmann::ordered_json packed_surface(const TriMesh& mesh, const Scene& scene,
                                      const PageLimits& limits = {}, const Progress& progress = {});

/// A texture as the page's script reads it: "pages", JPEG files in base64; "places", of each corner
/// of each face two numbers of two bytes, the lower first, 65535 for the right or lower edge of its
/// page; and "page", of each face the number of its page. Null where there is no texture.
nlohmann::ordered_json packed_texture(const Texture& texture, const PageLimits& limits = {});

/// A depth map beside its photograph as the page's script reads it: "photograph" and "depth", JPEG
/// files in base64, and "name", that of the view. Null if there is none.
nlohmann::ordered_json packed_depth(const DepthPicture& picture, const Scene& scene);

/// The points of a scene, its views as frusta, the direction that is up (up_of) and the view to
/// start from: the one that saw most of what was looked at (seen_places), with the median depth of
/// its points. "start" is null where there is no view.
nlohmann::ordered_json packed_scene(const Scene& scene, const PageLimits& limits = {});

/// The faces that were taken away, the largest where there are too many, in their order: positions,
/// faces and per face the number of its reason; and of the reasons that occur, in that order, the
/// name and how many faces in all it took away.
nlohmann::ordered_json packed_removed(const RemovedFaces& removed, const PageLimits& limits = {});

} // namespace vcarve
