#pragma once

#include "render/raster.h"
#include "render/shapes.h"

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace vcarve::render {

/// What the pictures lose on the sensor.
struct Grain {
    double blur_px = 0.0; ///< standard deviation of a Gaussian
    double noise = 0.0;   ///< standard deviation, of 255
};

/// From the frame the scene is built in to the one its truth is written in.
struct Frame {
    double scale = 1.0;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero(); ///< after scale and turn

    Eigen::Vector3d operator()(const Eigen::Vector3d& place) const
    {
        return scale * (turn * place) + shift;
    }
};

/// A scene and how it is photographed: all that a reconstruction starts from.
struct PhotoScene {
    Parts parts;
    std::vector<Pinhole> views; ///< all with the same lens and size
    int features = 2200;        ///< to find in a view, at most
    double pair_reach = 1000.0; ///< views with centres farther apart are not matched
    Grain grain;
    Frame frame;
};

/// Names of the scenes there are: the still life of fixtures/scene first, then the others, which
/// quality is studied on. Units and frames differ from scene to scene on purpose.
std::vector<std::string> photo_scene_names();

/// The scene of that name, the same on every machine. Throws UsageError where there is none.
PhotoScene photo_scene(std::string_view name);

} // namespace vcarve::render
