#pragma once

#include "paper/box_solid.h"
#include "paper/sample_surface.h"

#include <Eigen/Geometry>

#include <cstdint>
#include <random>
#include <vector>

namespace vcarve::paper {

/// A square camera with a field of view of about 92 degrees, square to the axes: rotations are
/// exact in double precision, and so is the centre that a reader computes from the pose.
struct ExactView {
    Spot center;
    int rotation = 0;                ///< index into exact_rotations()
    std::vector<std::uint32_t> sees; ///< samples in the image with nothing solid before them
};

inline constexpr int kImageSizePx = 1000;
inline constexpr double kFocalPx = 480.0;

/// The twelve turns whose quaternions have entries 0, 1/2, -1/2 and 1 only.
const std::vector<Eigen::Quaterniond>& exact_rotations();

/// Where a view has a point in its image, in px. The point must lie before the camera.
Eigen::Vector2d project(const ExactView& view, const Spot& spot);

/// Views such that a sight crosses a facet of every empty cell, no sight touches the solid, none
/// passes through an edge or a vertex of the triangulation, and every sample is seen by at least
/// three views that lie at least 20 degrees apart around it.
std::vector<ExactView> place_views(const BoxSolid& solid, const std::vector<Spot>& samples,
                                   const Cells& cells, std::mt19937_64& random);

} // namespace vcarve::paper
