#pragma once

#include "random.h"
#include "vcarve/scene.h"

#include <memory>

namespace vcarve::bench {

/// A position on a surface and its unit normal.
struct Spot {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
};

/// A shape about two units wide, and the views that photograph it. All views share one camera.
class SampleShape {
  public:
    virtual ~SampleShape() = default;

    virtual Spot spot(Random& random) const = 0;
    /// A random position with a good view of a spot.
    virtual Eigen::Vector3d vantage(const Spot& spot, Random& random) const = 0;
    /// Positive outside, negative inside.
    virtual double height_above(const Eigen::Vector3d& place) const = 0;
    /// A box around the shape and its points.
    virtual Eigen::AlignedBox3d box() const = 0;
    virtual double area() const = 0;
    virtual std::vector<View> views(std::size_t count) const = 0;
};

/// A sphere with bumps, seen from all around.
std::unique_ptr<SampleShape> bumpy_ball();

/// Hills, seen from the air in strips.
std::unique_ptr<SampleShape> terrain();

/// A room with four round columns, seen from inside.
std::unique_ptr<SampleShape> hall();

/// The camera of all views.
Camera sample_camera();

/// The position in camera coordinates, z forward, and its projection in pixels.
Eigen::Vector3d in_camera(const View& view, const Eigen::Vector3d& place);
Eigen::Vector2d in_image(const Eigen::Vector3d& place_in_camera);

} // namespace vcarve::bench
