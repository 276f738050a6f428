#pragma once

#include "io/ply/ply_cloud.h"

#include <cstdint>
#include <string>
#include <vector>

namespace vcarve {

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
