#pragma once

#include "base/progress.h"
#include "steps/2_planes/candidate.h"
#include "steps/2_planes/planar_regions.h"
#include "vcarve/scene.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A point that a scene shall get.
struct AcceptedPoint {
    Candidate candidate;
    std::vector<std::uint32_t> beside = {}; ///< the nearest points of its regions
    std::vector<std::uint32_t> track = {};  ///< the views that see it, ascending; two at least
};

/// The candidates that are right as far as points and sights tell, in their order. Each of them
/// must stand the following tests, which are the same whoever proposes it:
///
/// 1. No point of the scene is within three tenths of its step (of half a step amid a region).
/// 2. Of the eight points nearest to it five belong to its regions: nothing else stands there, and
///    a surface that bends does not go on.
/// 3. Two views see it. Those that saw the nearest points of its regions are asked; they must show
///    the place and stand before the planes of all its regions, or, where it stands out, of one.
///    Amid a region they must look at it, too (views_looking.h).
/// 4. Through its surface pass fewer sights than see it: where none is, one looks through. Of each
///    sight the spacing at its point is left out.
/// 5. No candidate that was accepted before it is within half a step.
///
/// Cost: O(log points) a candidate and O(log candidates) a sight, in parallel.
std::vector<AcceptedPoint> accept(const Scene& scene, const PlanarRegions& planes,
                                  std::vector<Candidate> candidates, const Progress& progress);

} // namespace vcarve
