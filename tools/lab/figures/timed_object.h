#pragma once

#include "vcarve/scene.h"

#include <cstddef>

namespace vcarve::paper {

/// The object that table 1 is measured on: a block with a pit, on which sampling for carving
/// (sample_surface.h) puts as many points as the paper's object had.
inline constexpr std::size_t kPapersPoints = 29;

/// The object of so many points, the paper's number or more, which are spread evenly by chance; and
/// the first so many viewpoints of a sequence that goes round above it, each seeing every point
/// that the object does not hide. The same arguments give the same scene, its points in the order
/// of a run's. Throws where no sampling gives the paper's number.
Scene timed_object(std::size_t points, std::size_t viewpoints);

} // namespace vcarve::paper
