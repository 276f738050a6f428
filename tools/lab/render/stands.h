#pragma once

#include "render/raster.h"

#include <vector>

namespace vcarve::render {

struct Lens {
    int width_px = 800;
    int height_px = 600;
    double focal_px = 760.0;
};

/// A level camera at a place that looks at another, z upwards.
Pinhole looking_at(const Lens& lens, const Eigen::Vector3d& center, const Eigen::Vector3d& target);

/// Cameras on an arc of a level circle around a target, evenly spaced, all looking at it. Turn 0
/// stands at -y of the target, 90 at +x.
struct Arc {
    Eigen::Vector3d target;
    double radius;
    double height; ///< z of the cameras
    double first_deg;
    double step_deg;
    int count;
};
void add_arc(std::vector<Pinhole>& views, const Lens& lens, const Arc& arc);

} // namespace vcarve::render
