#pragma once

#include "render/raster.h"
#include "render/shapes.h"

#include <Eigen/Geometry>

#include <string>
#include <string_view>
#include <vector>

namespace vcarve::render {

/// Degradation of the images by the sensor.
struct Grain {
    double blur_px = 0.0; ///< standard deviation of a Gaussian
    double noise = 0.0;   ///< standard deviation, in levels of 255
};

/// The transformation from the frame of the scene to the frame of its truth file.
struct Frame {
    double scale = 1.0;
    Eigen::Quaterniond turn = Eigen::Quaterniond::Identity();
    Eigen::Vector3d shift = Eigen::Vector3d::Zero(); ///< after scale and turn

    Eigen::Vector3d operator()(const Eigen::Vector3d& place) const
    {
        return scale * (turn * place) + shift;
    }
};

/// A scene and its photographs: the input of a reconstruction.
struct PhotoScene {
    Parts parts;
    std::vector<Pinhole> views; ///< all with the same lens and size
    int features = 2200;        ///< maximum number per view
    double pair_reach = 1000.0; ///< views with centers farther apart are not matched
    Grain grain;
    Frame frame;
};

/// The names of the scenes: first the still life of fixtures/scene, then the scenes for studies of
/// quality. Units and frames intentionally differ between scenes.
std::vector<std::string> photo_scene_names();

/// The scene with this name, the same on every machine. Throws UsageError if it is unknown.
PhotoScene photo_scene(std::string_view name);

} // namespace vcarve::render
