#pragma once

#include <Eigen/Core>

#include <filesystem>

namespace vcarve {

/// The part of space that a surface is wanted of, as an option says it: in the coordinates of the
/// model's file.
struct RegionChoice {
    /// How the part is given.
    enum class Kind {
        everything, ///< all of space
        looked_at,  ///< the ball in which 94 % of the sights end
        box,        ///< from `low` to `high` along the axes
        file        ///< within the closed surface or over the polygon in `file`
    };

    Kind kind = Kind::everything;                   ///< which of them
    Eigen::Vector3d low = Eigen::Vector3d::Zero();  ///< of a box, the smallest coordinates
    Eigen::Vector3d high = Eigen::Vector3d::Zero(); ///< of a box, the largest, each above `low`
    /// A PLY file with a closed surface of triangles, its name ending with .ply; or a text file
    /// with the x and y of one corner of a polygon a line, which stands for all z.
    std::filesystem::path file = {};
};

} // namespace vcarve
