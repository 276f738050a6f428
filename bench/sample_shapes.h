#pragma once

#include "random.h"
#include "vcarve/scene.h"

#include <memory>

namespace vcarve::bench {

/// A place on a surface, with the unit normal there.
struct Spot {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
};

/// Something to be photographed, about two units across, and the views that do it. All views share
/// one camera.
class SampleShape {
  public:
    virtual ~SampleShape() = default;

    virtual Spot spot(Random& random) const = 0;
    /// Where one would stand to see a spot well; differs from call to call.
    virtual Eigen::Vector3d vantage(const Spot& spot, Random& random) const = 0;
    /// Positive outside, negative inside.
    virtual double height_above(const Eigen::Vector3d& place) const = 0;
    /// Everything lies within these corners.
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

/// What all views were taken with.
Camera sample_camera();

/// Where a place appears in a view, in pixels; the view looks along its z.
Eigen::Vector3d in_camera(const View& view, const Eigen::Vector3d& place);
Eigen::Vector2d in_image(const Eigen::Vector3d& place_in_camera);

} // namespace vcarve::bench
