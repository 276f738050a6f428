#pragma once

#include "paper/box_solid.h"
#include "paper/sample_surface.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <random>
#include <vector>

namespace vcarve::paper {

/// An axis-aligned square camera with a field of view of about 92 degrees. Its rotation, and the
/// center that a reader computes from the pose, are exact in double precision.
struct ExactView {
    Spot center;
    int rotation = 0;                ///< index into exact_rotations()
    std::vector<std::uint32_t> sees; ///< unoccluded samples in the image
};

inline constexpr int kImageSizePx = 1000;
inline constexpr double kFocalPx = 480.0;

/// The twelve rotations whose quaternions have only the entries 0, 1/2, -1/2 and 1.
const std::vector<Eigen::Quaterniond>& exact_rotations();

/// The image position of a point, in px. The point must be in front of the camera.
Eigen::Vector2d project(const ExactView& view, const Spot& spot);

/// Places views with these properties: a ray crosses a facet of every empty cell, no ray touches
/// the solid or passes through an edge or vertex of the triangulation, and at least three views, 20
/// degrees or more apart, see every sample.
std::vector<ExactView> place_views(const BoxSolid& solid, const std::vector<Spot>& samples,
                                   const Cells& cells, std::mt19937_64& random);

} // namespace vcarve::paper
