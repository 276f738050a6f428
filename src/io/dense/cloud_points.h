#pragma once

#include "io/ply/ply_file.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

/// Gives the points of a scene, whose positions were taken from a cloud, what else is known of
/// them: point_ids are places in the file, from `first`, errors are unknown, colours that the file
/// lacks are black, normals are of unit length, or zero where the file's is no direction. Cost:
/// O(points), in parallel.
void take_attributes(PointCloud cloud, std::uint64_t first, Scene& scene);

/// Where the Gaussians that were kept stood in their file, and a sentence on the others.
struct KeptSplats {
    std::vector<std::uint64_t> places;
    std::string note; ///< empty where all were kept
};

/// Leaves of a cloud of Gaussians those whose middle is likely on a surface. Faint ones go, of less
/// than half the opacity: more of what lies behind than of them would be seen through their
/// middles, so they are haze or made to tint others. Of the others those go whose largest half-axis
/// is ten times the median: they stand for sky, or for what training saw from afar, and where in
/// them a surface is, nobody knows. Cost: O(points).
KeptSplats keep_solid_splats(PointCloud& cloud);

} // namespace vcarve
