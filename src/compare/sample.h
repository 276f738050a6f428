#pragma once

#include "vcarve/tri_mesh.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vcarve {

/// Points spread over a surface, and the faces they lie on. The arrays run parallel.
struct SurfaceSamples {
    std::vector<Eigen::Vector3d> positions; ///< in the frame of the mesh's positions
    std::vector<std::uint32_t> faces;       ///< ascending
};

/// `count` samples by area: the area is cut into `count` equal parts, one random sample in each, so
/// a face of a share s of the area gets s x count samples, give or take one. Empty where no face
/// has area. Cost: O(faces + count).
SurfaceSamples sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed);

} // namespace vcarve
