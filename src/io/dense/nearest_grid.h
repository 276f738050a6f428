#pragma once

#include "io/dense/image_squares.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <cstddef>
#include <optional>
#include <vector>

namespace vcarve {

/// Where a point is in an image, and how far from its view.
struct Projected {
    Eigen::Vector2d place_px;
    float distance = 0.0F;
};

/// Where a view shows a place; nothing where it is not in its image.
std::optional<Projected> project_into(const View& view, const Camera& camera,
                                      const Eigen::Vector3d& place);

/// What a view finds nearest in the squares of a grid over its image.
class NearestGrid {
  public:
    /// An empty one. How far apart the points of `scene` stand in the image is told by every
    /// `stride`th of `places`, which are all of them. The camera has a size.
    NearestGrid(const View& view, const Scene& scene, const std::vector<Eigen::Vector3d>& places,
                std::size_t stride);

    /// Takes in a point, which may hide others, if it is in the image.
    void add(const Eigen::Vector3d& position);
    /// Whether a point is in the image, and no other that was added is clearly before it.
    bool sees(const Eigen::Vector3d& position) const;
    /// By how much the directions of points in one square may differ, about.
    double square_angle() const { return square_angle_; }

  private:
    void lay_squares(double width, double share, double count);
    void set_depth(double steepest);
    double radians_a_pixel() const;

    const View& view_;
    const Camera& camera_;
    ImageSquares squares_;
    double square_angle_ = 0.0;
    float hides_from_ = 1.0F;  ///< of a point's distance: what is nearer hides it
    std::vector<float> least_; ///< of each square, row by row
};

} // namespace vcarve
