#pragma once

#include "observed/observed_scene.h"
#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve::observed {

/// A scene as dense stereo of real pictures and the fusion of its depths would give it, poses
/// aside, which are exact: points by area of what three views or more agree on. A view that sees a
/// place from within 60 degrees of the one whose depth it is agrees with three chances in four. The
/// depth is off along the sight of that view by half a pixel of disparity at a fifth of the depth
/// for a baseline (a normal distribution), less by the root of the number of views, and the normal
/// by some degrees. One point in two hundred is false, up to a tenth of the depth before or behind
/// the surface. The same on every machine, up to the rounding of sine and cosine in `observed`.
Scene observe_densely(const ObservedScene& observed, std::size_t num_points);

} // namespace vcarve::observed
