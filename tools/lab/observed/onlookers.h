#pragma once

#include "geometry/triangle_tree.h"
#include "observed/observe.h"
#include "random.h"
#include "render/shapes.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace vcarve::observed {

/// A position on the true surface.
struct Spot {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    render::Paint paint;
};

/// The density of positions: features are found by area and contrast, stereo depths by area alone.
enum class Spread { area_and_contrast, area };

/// Draws random positions on a surface.
class Spots {
  public:
    /// `parts` must outlive this.
    Spots(const render::Parts& parts, Spread spread);

    Spot draw(bench::Random& random) const;

  private:
    std::array<Eigen::Vector3d, 3> corners_of(std::size_t face) const;
    Eigen::Vector3d normal_of(std::size_t face) const;
    const render::Paint& paint_of(std::size_t face) const;

    const render::Parts& parts_;
    std::vector<double> sums_; ///< cumulative weights of the faces
};

/// The views of a scene, and the visibility of its true surface.
class Onlookers {
  public:
    explicit Onlookers(const ObservedScene& observed);

    const Camera& camera() const { return camera_; }
    const std::vector<View>& views() const { return views_; }

    /// The views that show the spot unoccluded, at less than 75 degrees from its normal.
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
