#pragma once

#include "compare/reference.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

/// Which of the samples of a surface are named as its worst. Lengths are in the samples' unit.
struct WorstChoice {
    double cell = 0.0;     ///< edge of the cubes in which distances are summed
    double apart = 0.0;    ///< the least distance of two that are named
    double least = 0.0;    ///< nearer samples are never named
    std::size_t count = 8; ///< how many are named at most
};

/// Samples of a surface, evenly spread by area, and how far each lies from another surface: names
/// those where much of it lies far, the worst first. In every cube of a grid the distances over
/// `least` are summed, which is area times distance; of the cubes in the order of that sum, each
/// names its farthest sample, unless one was named nearer than `apart`, or nearer than the smaller
/// of the two samples' distances: what lies far out in one lump is named once. Equal sums and
/// distances go by the samples' order. Precondition: cell > 0. Cost: O(n log n).
std::vector<std::size_t> worst_samples(std::span<const Eigen::Vector3d> samples,
                                       std::span<const double> distances,
                                       const WorstChoice& choice);

/// A place where a surface lies far from another.
struct WorstPlace {
    Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< in the reference's frame
    double distance = 0.0;                              ///< in diagonals
    Eigen::Vector3d towards = Eigen::Vector3d::UnitZ(); ///< unit, to where it is well seen from
    double reach = 0.0; ///< how far off the view stands that sees it from there; 0 if none does
    /// How many views see it, see view_sees(). A place on the truth counts only where enough views
    /// see it: of that it says 0 where no image holds it, and else nothing.
    std::optional<std::int64_t> views = {};
};

/// What distances are shares of: the truth's diagonal; where there is none, that of the box of the
/// middle nine tenths of the points, or of all of them where that has no size.
double diagonal_of(const Reference& reference);

/// Samples of a mesh, and how far each lies from another surface. The arrays run parallel.
struct SurfaceDistances {
    SurfaceSamples samples; ///< at most 100,000, by area, the same for the same mesh and options
    std::vector<double> distances; ///< in diagonals
};

SurfaceDistances surface_distances(const MeasuredMesh& mesh, const TriangleTree& other,
                                   const Reference& reference);

/// Where a mesh lies farthest from the surface that `far` tells the distances to, `count` places at
/// most.
std::vector<WorstPlace> wrong_places(const MeasuredMesh& mesh, const SurfaceDistances& far,
                                     const Reference& reference, std::size_t count);

/// Where the part of the truth that counts lies farthest from a mesh. Precondition: the reference
/// has a truth.
std::vector<WorstPlace> missing_places(const MeasuredMesh& mesh, const Reference& reference,
                                       std::size_t count);

} // namespace vcarve
