#pragma once

#include <Eigen/Core>

#include <filesystem>

namespace vcarve {

/// The region to reconstruct, as an option specifies it, in the coordinates of the model's file.
struct RegionChoice {
    /// The shape of the region.
    enum class Kind {
        everything, ///< all of space
        looked_at,  ///< the ball in which 94 % of the rays end at their points
        box,        ///< an axis-aligned box from `low` to `high`
        file        ///< inside the closed surface or over the polygon in `file`
    };

    Kind kind = Kind::everything;                   ///< the shape of the region
    Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< box: smallest coordinates
    Eigen::Vector3d high = Eigen::Vector3d::Zero(); ///< box: largest coordinates, each above `low`
    /// A file NAME.ply has a closed triangle surface. Any other file is text with the x and y of
    /// one polygon corner per line; the polygon applies to all z.
    std::filesystem::path file = {};
};

} // namespace vcarve
