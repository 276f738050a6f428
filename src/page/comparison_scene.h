#pragma once

#include "base/progress.h"
#include "compare/reference.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>

namespace vcarve {

/// Limits of a comparison page, so that it opens at once and two surfaces of 100,000 faces stay
/// below 16 MB.
struct ComparisonLimits {
    std::int64_t faces = 200'000;     ///< per surface; larger surfaces are simplified
    std::int64_t all_faces = 400'000; ///< of all surfaces together, divided evenly
    std::int64_t places = 8;          ///< worst positions per surface
};

/// Returns the data that a comparison page draws: `scene`, which packed_scene() made of the model,
/// in the reference's frame, with
/// - "middle": center and radius of the region in view,
/// - "diagonal": the unit of distances, in model units; "diagonal_of": "truth" or "points",
/// - "scale": the distance at which colors end: the least round one from 0.1 % to 5 % that 90 % of
///   every mesh's area does not exceed, or 5 %,
/// - "surfaces": the meshes, and then the truth if the reference has one. Each has "name",
///   "is_truth", "of" (its number of faces), and positions, faces and colors as in pack.h,
/// - in a measured surface, else null: "measured_to", the name of the other surface; "distances" of
///   vertices and of positions between them (see display_mesh.h); "wrong" and "missing", the worst
///   positions.
/// Meshes are measured against the truth. Without a truth they are measured against the first mesh,
/// and the first mesh against the second. Names of meshes are the column headings. Throws
/// Cancelled, and InputError like place_mesh().
nlohmann::ordered_json comparison_scene(nlohmann::ordered_json scene,
                                        const Eigen::Vector3d& scene_offset,
                                        std::span<const NamedMesh> meshes,
                                        const Reference& reference, const Progress& progress = {});

} // namespace vcarve
