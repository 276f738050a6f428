#pragma once

#include "vcarve/tri_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Why a face of the boundary is not in the surface.
enum class Removal : std::uint8_t { unseen, closing, outside_region, small_piece, trimmed };

/// What each is called, as the stages count them.
inline constexpr std::array<const char*, 5> kRemovalNames = {
    "unseen", "closing without support", "outside the region", "small pieces", "trimmed"};

/// The faces that were taken away, and why. Vertices have places only, in the frame of the scene.
struct RemovedFaces {
    TriMesh mesh;
    std::vector<Removal> reasons; ///< one a face
};

} // namespace vcarve
