#pragma once

#include <cstddef>
#include <string_view>

namespace vcarve {

/// How a lens brings directions to its image plane, before any polynomial moves them there.
enum class LensGeometry {
    perspective,     ///< by the tangent of the angle to the axis
    fisheye,         ///< by the angle itself
    fov,             ///< Devernay and Faugeras, 2001
    division,        ///< Fitzgibbon, 2001
    unified,         ///< the enhanced unified model; Khomutenko, Garcia and Martinet, 2016
    equirectangular, ///< longitude and latitude
};

/// One of COLMAP's camera models. Its parameters are its focal lengths, the principal point unless
/// it has no focal length, and then what distorts.
struct LensModel {
    int number = 0;             ///< in binary files
    std::string_view name;      ///< in cameras.txt
    std::size_t num_params = 0; ///< all of them
    std::size_t num_focals = 0; ///< 1, 2 for the two axes, or 0
    LensGeometry geometry = LensGeometry::perspective;
    bool polynomial = false; ///< a LensDistortion follows
};

/// The model with this number, or null where COLMAP (4.2, and the two models it got since) has none
/// such. Cost: O(1).
const LensModel* lens_model(int number);

/// The model with this name, or null.
const LensModel* lens_model(std::string_view name);

} // namespace vcarve
