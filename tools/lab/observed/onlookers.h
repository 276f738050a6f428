#pragma once

#include "geometry/triangle_tree.h"
#include "observed/observed_scene.h"
#include "observed/spots.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve::observed {

/// The views of a scene, and what of its true surface they see.
class Onlookers {
  public:
    explicit Onlookers(const ObservedScene& observed);

    const Camera& camera() const { return camera_; }
    const std::vector<View>& views() const { return views_; }

    /// The views that have the spot in their image, look at it from less than 75 degrees off its
    /// normal, and have nothing in between.
    std::vector<std::uint32_t> seeing(const Spot& spot) const;

    Eigen::Vector3d in_camera(std::uint32_t view, const Eigen::Vector3d& position) const;
    std::optional<Eigen::Vector2d> place_px(std::uint32_t view,
                                            const Eigen::Vector3d& position) const;

  private:
    Camera camera_;
    TriangleTree tree_;
    std::vector<View> views_;
};

} // namespace vcarve::observed
