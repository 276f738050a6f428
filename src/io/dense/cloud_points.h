#pragma once

#include "io/ply/ply_cloud.h"
#include "vcarve/scene.h"

#include <cstdint>

namespace vcarve {

/// Gives the points of a scene, whose positions were taken from a cloud, what else is known of
/// them: point_ids are places in the file, from `first`, errors are unknown, colours that the file
/// lacks are black, normals are of unit length, or zero where the file's is no direction. Cost:
/// O(points), in parallel.
void take_attributes(PointCloud cloud, std::uint64_t first, Scene& scene);

} // namespace vcarve
