#pragma once

#include "render/raster.h"
#include "render/shapes.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <string>
#include <vector>

namespace vcarve::observed {

/// What a fixture is made of. The contrast of a part's paint says how many features a matcher finds
/// on it, relative to other parts of the same area: none where it is 0.
struct ObservedScene {
    std::string name; ///< of the fixture's folder
    render::Parts parts;
    std::vector<render::Pinhole> views; ///< all of one lens
    std::size_t points = 0;             ///< of the model, outliers included
};

/// Hills with houses, trees and a wall, seen from straight above and askew. Most walls are plain.
ObservedScene from_the_air();

/// A furnished room seen from within. Walls and ceiling are plain.
ObservedScene inside_a_room();

/// Where a view has a point in its image.
struct Observation {
    std::uint32_t point = 0; ///< index into Scene::positions
    Eigen::Vector2d place_px;
};

/// A scene as matching and mapping of real pictures would give it, poses aside, which are exact.
struct ObservedModel {
    Scene scene;
    std::vector<std::vector<Observation>> observations; ///< of each view, by ascending point
};

/// Points by area and contrast of what two views or more see: places in the images are off by 0.7
/// px each way (a normal distribution), and the point lies where they fit best, so that it is off
/// mostly along its sights. A view finds a point again only where it looks from within 35 degrees
/// of the view that found it first, and then with two chances in three. One point in a hundred is a
/// false match, somewhere along the sight of a true one. The same on every machine, up to the
/// rounding of sine and cosine in `observed`.
ObservedModel observe(const ObservedScene& observed);

/// A scene as dense stereo of real pictures and the fusion of its depths would give it, poses
/// aside, which are exact: points by area of what three views or more agree on. A view that sees a
/// place from within 60 degrees of the one whose depth it is agrees with three chances in four. The
/// depth is off along the sight of that view by half a pixel of disparity at a fifth of the depth
/// for a baseline (a normal distribution), less by the root of the number of views, and the normal
/// by some degrees. One point in two hundred is false, up to a tenth of the depth before or behind
/// the surface. The same on every machine, up to the rounding of sine and cosine in `observed`.
Scene observe_densely(const ObservedScene& observed, std::size_t num_points);

} // namespace vcarve::observed
