#pragma once

#include "render/raster.h"
#include "render/shapes.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace vcarve::observed {

/// The source of a fixture. The contrast of a part's paint is proportional to the density of
/// features that a matcher finds on it; a contrast of 0 gives none.
struct ObservedScene {
    std::string name; ///< name of the fixture's folder
    render::Parts parts;
    std::vector<render::Pinhole> views; ///< all with the same lens
    std::size_t points = 0;             ///< number in the model, including outliers
};

/// Hills with houses, trees and a wall, in nadir and oblique views. Most walls are plain.
ObservedScene from_the_air();

/// A furnished room seen from inside. Walls and ceiling are plain.
ObservedScene inside_a_room();

/// The pixel of a point in a view.
struct Observation {
    std::uint32_t point = 0; ///< index into Scene::positions
    Eigen::Vector2d place_px;
};

/// A scene like those from matching and mapping photographs, but with exact poses.
struct ObservedModel {
    Scene scene;
    std::vector<std::vector<Observation>> observations; ///< per view, by ascending point
};

/// Samples points, by area and contrast, on the surface that two or more views see. Pixels have a
/// normally distributed error of 0.7 px in x and y. The point minimizes the reprojection error, so
/// its error is mostly along its rays. Another view finds a point with probability 2/3 if it is
/// within 35 degrees of the first view. One point in a hundred is a false match on the ray of a
/// true one. The same on every machine, up to the rounding of sine and cosine in `observed`.
ObservedModel observe(const ObservedScene& observed);

/// A scene like those from dense stereo and fusion of photographs, but with exact poses. Points are
/// sampled by area on the surface on which three or more views agree. A view within 60 degrees of
/// the reference view agrees with probability 3/4. The depth has a normally distributed error of
/// half a pixel of disparity, for a baseline of a fifth of the depth, divided by the root of the
/// number of views. Normals are off by some degrees. One point in two hundred is false, up to a
/// tenth of the depth in front of or behind the surface. The same on every machine, up to the
/// rounding of sine and cosine in `observed`.
Scene observe_densely(const ObservedScene& observed, std::size_t num_points);

} // namespace vcarve::observed
