#pragma once

#include "base/progress.h"
#include "compare/reference.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <span>

namespace vcarve {

/// How much of a comparison a page holds, so that it opens at once and two surfaces of 100,000
/// faces stay below 16 MB.
struct ComparisonLimits {
    std::int64_t faces = 200'000;     ///< of a surface; larger ones are simplified
    std::int64_t all_faces = 400'000; ///< of all surfaces together, evenly
    std::int64_t places = 8;          ///< worst places a surface
};

/// What the page of a comparison draws: `scene`, which packed_scene() made of the model, moved into
/// the reference's frame, with
/// - "middle": the center and radius of what is looked at,
/// - "diagonal": what distances are shares of, in the model's units; "diagonal_of": "truth" or
///   "points",
/// - "scale": the distance at which colours end: of the round ones from 0.1 % to 5 % the least that
///   nine tenths of every mesh's area do not exceed, or 5 %,
/// - "surfaces": the meshes, and after them the truth where the reference has one. Each has "name",
///   "is_truth", "of" (how many faces it has), positions, faces and colours as pack.h has them; of
///   a mesh that is measured against something "measured_to" is its name, "distances" are those of
///   the vertices and of the places between them (see display_mesh.h), and "wrong" and "missing"
///   are its worst places; else they are null.
/// A mesh is measured against the truth; where there is none against the first mesh, the first one
/// against the second. The meshes' names are the columns'.
/// Throws InputError as place_mesh does, and Cancelled.
nlohmann::ordered_json comparison_scene(nlohmann::ordered_json scene,
                                        const Eigen::Vector3d& scene_offset,
                                        std::span<const NamedMesh> meshes,
                                        const Reference& reference, const Progress& progress = {});

} // namespace vcarve
