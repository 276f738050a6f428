#pragma once

#include "compare/reference.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

/// Options of worst_samples(). Lengths are in the samples' unit.
struct WorstChoice {
    double cell = 0.0;     ///< edge of the cubes in which distances are summed
    double apart = 0.0;    ///< minimum distance of two results
    double least = 0.0;    ///< samples with at most this distance are ignored
    std::size_t count = 8; ///< maximum number of results
};

/// Returns the worst of a surface's samples, whose distances to another surface are `distances`,
/// worst first. Samples are uniform by area. Sums the distances above `least` in each cube of a
/// grid: area times distance. In decreasing order of this sum, each cube adds its farthest sample.
/// It is skipped if a result is nearer than `apart`, or nearer than the smaller of both samples'
/// distances, so that a region far away appears only once. The samples' order breaks ties.
/// Precondition: cell > 0. Cost: O(n log n).
std::vector<std::size_t> worst_samples(std::span<const Eigen::Vector3d> samples,
                                       std::span<const double> distances,
                                       const WorstChoice& choice);

/// A position where a surface is far from another.
struct WorstPlace {
    Eigen::Vector3d position = Eigen::Vector3d::Zero(); ///< in the reference's frame
    double distance = 0.0;                              ///< in diagonals
    Eigen::Vector3d towards = Eigen::Vector3d::UnitZ(); ///< unit vector to a good viewpoint
    double reach = 0.0; ///< distance of the view at this viewpoint; 0: no view
    /// The number of views that see it, see view_sees(). On the truth, which enough views see, it
    /// is 0 if no image contains the position, and else empty.
    std::optional<std::int64_t> views = {};
};

/// The unit of distances: the diagonal of the truth. Without a truth, the diagonal of the box of
/// the central 90 % of the points, or of all points if that is 0.
double diagonal_of(const Reference& reference);

/// Samples of a mesh and their distances to another surface, as parallel arrays.
struct SurfaceDistances {
    SurfaceSamples samples;        ///< at most 100,000, by area, reproducible
    std::vector<double> distances; ///< in diagonals
};

SurfaceDistances surface_distances(const MeasuredMesh& mesh, const TriangleTree& other,
                                   const Reference& reference);

/// Returns at most `count` positions where a mesh is farthest from the other surface of `far`.
std::vector<WorstPlace> largest_deviations(const MeasuredMesh& mesh, const SurfaceDistances& far,
                                           const Reference& reference, std::size_t count);

/// Returns at most `count` positions where the part of the truth that counts is farthest from a
/// mesh. Precondition: the reference has a truth.
std::vector<WorstPlace> largest_gaps(const MeasuredMesh& mesh, const Reference& reference,
                                     std::size_t count);

} // namespace vcarve
