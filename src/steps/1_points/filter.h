#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// Which points are at one place: for every point the first of those at its place, which may be the
/// point itself. Points are at one place if they are nearer to each other, along each axis, than
/// 1e-9 of the diagonal of the box of the middle half of all, or if others lie between them so;
/// where these would be more than 8, which may be a part of the scene that lies far from the rest,
/// they are judged by themselves in the same way, and by the rounding of their coordinates. COLMAP
/// often has a point twice, triangulated from other views of the same track, and the two differ in
/// their last digits; which digits those are depends on where the model lies. Distances that
/// photographs can tell are a million times as large. Only the points in `finite` count, each of
/// which must be finite; any other is alone. The result does not depend on where and how large the
/// scene is, up to rounding. Cost: O(points log points), in parallel.
std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite);

/// How many points were dropped, and why; each dropped point counts once, for the first reason.
struct FilterReport {
    std::int64_t non_finite = 0; ///< a coordinate is not a finite number, or beyond 1e100
    std::int64_t duplicate = 0;  ///< merged into another point at the same place
    std::int64_t few_views = 0;
    std::int64_t high_error = 0;
    std::int64_t low_angle = 0;
};

struct FilteredPoints {
    Scene scene;
    FilterReport report;
};

/// The points fit for a triangulation: finite, no two at one place, each seen well enough. A point
/// that a scanner measured is known from one view, so that neither the number of its views nor the
/// angle between its sights is asked. Points at one place, but for rounding (first_at_place),
/// become one, with the views of all, and what else belongs to the best of them (most views, then
/// smallest error, then smallest id). The order of the points is that of the input. Cost: O(points
/// log points + sights), in parallel, and 36 bytes a point beside the scene, if it is moved here.
FilteredPoints filter_points(Scene scene, const FilterOptions& options,
                             const Progress& progress = {});

/// Median over the points of the widest angle between their first ray and another, in degrees.
/// Points of one view or of a scanner do not count; 0 if none counts. Cost: O(rays), of 100,000
/// points at most.
double median_angle_deg(const Scene& scene);

} // namespace vcarve
