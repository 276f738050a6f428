#pragma once

#include "observed/observed_scene.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve::observed {

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

} // namespace vcarve::observed
