#pragma once

#include "base/progress.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace vcarve {

/// Returns for each point the first point at the same position, which may be itself. This means
/// that they differ by at most 1e-9 of the scene size along each axis, or that other points connect
/// them. The scene size is the diagonal of the box of the middle half of the points. Groups of more
/// than 8 points may be a part of the scene far from the rest. They are compared again by their own
/// size and the rounding of their coordinates. COLMAP often triangulates a point twice, from
/// different views of the same track. The copies differ in their last digits, which depend on the
/// position of the model. Distances that photographs resolve are a million times as large. Only the
/// points in `finite`, which must be finite, are compared; the others are alone. The result does
/// not depend on the position and scale of the scene, up to rounding. Cost: O(points log points),
/// in parallel.
std::vector<std::uint32_t> first_at_place(const std::vector<Eigen::Vector3d>& positions,
                                          const std::vector<std::uint32_t>& finite);

/// The number of dropped points per reason. Each dropped point counts once, for the first reason.
struct FilterReport {
    std::int64_t non_finite = 0; ///< a coordinate is not finite, or beyond 1e100
    std::int64_t duplicate = 0;  ///< merged into another point at the same position
    std::int64_t few_views = 0;
    std::int64_t high_error = 0;
    std::int64_t low_angle = 0;
};

struct FilteredPoints {
    Scene scene;
    FilterReport report;
};

/// Returns the points that are fit for a triangulation: finite, distinct and seen well enough. A
/// point that a scanner measured needs no second view and no angle between rays. Points at the same
/// position (first_at_place) become one, with the views of all. Its other values are those of the
/// best point (most views, then smallest error, then smallest id). The input order is kept. Cost:
/// O(points log points + rays), except for points at the limit of angles (wide_angle.h); in
/// parallel, and 36 bytes per point beside the scene, if it is moved here.
FilteredPoints filter_points(Scene scene, const FilterOptions& options,
                             const Progress& progress = {});

/// The median over the points of the widest angle between the first ray and another, in degrees.
/// Points with one view or of a scanner do not count; 0 if none counts. Cost: O(rays) of at most
/// 100,000 points.
double median_angle_deg(const Scene& scene);

} // namespace vcarve
