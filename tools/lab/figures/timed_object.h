#pragma once

#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve::paper {

/// The number of points of the object of table 1, a block with a pit. Sampling for carving
/// (sample_surface.h) gives the number of points of the paper's object.
inline constexpr std::size_t kPapersPoints = 29;

/// The object with `points` points: the paper's number, or more at random positions. The viewpoints
/// are the first of a sequence around and above it; each sees all points that the object does not
/// occlude. Equal arguments give equal scenes, with points in the order of a run. Throws if no
/// sampling gives the paper's number.
Scene timed_object(std::size_t points, std::size_t viewpoints);

} // namespace vcarve::paper
