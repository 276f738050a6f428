#pragma once

#include "model/photograph.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>

namespace vcarve {

/// A photograph of a view: how a place comes to its pixels, whose number may differ from what the
/// camera says, as after the photographs were made smaller.
struct CalibratedPhoto {
    std::filesystem::path file;
    PhotographSize size;
    std::uint32_t view = 0;         ///< index into Scene::views
    View pose;                      ///< its centre in the frame of the mesh
    double focal_px = 0.0;          ///< of the photograph, the mean
    Camera camera;                  ///< of the model
    Eigen::Array2d scale{1.0, 1.0}; ///< pixels of the photograph a pixel of the camera
};

/// The pixel of the photograph that shows a place in the frame of the mesh; the middle of the first
/// is (0.5, 0.5). Nothing where the photograph does not show it. Cost: as project().
std::optional<Eigen::Vector2d> pixel_of(const CalibratedPhoto& photo,
                                        const Eigen::Vector3d& position);

/// The same beyond the photograph's edges, too.
std::optional<Eigen::Vector2d> pixel_beyond(const CalibratedPhoto& photo,
                                            const Eigen::Vector3d& position);

} // namespace vcarve
