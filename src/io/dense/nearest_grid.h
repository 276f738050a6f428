#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace vcarve {

/// An image cut into squares, numbered row by row.
class ImageSquares {
  public:
    ImageSquares() = default;

    /// Squares of `width` point spacings, if `count` points cover the fraction `share` of the
    /// image. An image edge has at most `count` + 1 squares, however large the image.
    ImageSquares(const Camera& camera, double width, double share, double count)
    {
        const auto width_px = static_cast<double>(camera.width_px);
        const auto height_px = static_cast<double>(camera.height_px);
        side_px_ = std::max(width * std::sqrt(share * width_px * height_px / count),
                            std::max(width_px, height_px) / count);
        columns_ = static_cast<std::size_t>(width_px / side_px_) + 1;
        rows_ = static_cast<std::size_t>(height_px / side_px_) + 1;
    }

    double side_px() const { return side_px_; }
    std::size_t count() const { return columns_ * rows_; }

    std::size_t of(const Eigen::Vector2d& place_px) const
    {
        return index(place_px.y(), rows_) * columns_ + index(place_px.x(), columns_);
    }

    /// Whether is_so(square) is true for `square` or one of the eight around it.
    template <typename IsSo>
    bool any_around(std::size_t square, const IsSo& is_so) const
    {
        const std::size_t row = square / columns_;
        const std::size_t column = square % columns_;
        for (std::size_t r = row - std::min<std::size_t>(row, 1); r < std::min(row + 2, rows_);
             ++r) {
            for (std::size_t c = column - std::min<std::size_t>(column, 1);
                 c < std::min(column + 2, columns_); ++c) {
                if (is_so(r * columns_ + c)) return true;
            }
        }
        return false;
    }

  private:
    std::size_t index(double place_px, std::size_t count) const
    {
        const double last = static_cast<double>(count) - 1.0;
        return static_cast<std::size_t>(std::clamp(place_px / side_px_, 0.0, last));
    }

    double side_px_ = 1.0;
    std::size_t columns_ = 1;
    std::size_t rows_ = 1;
};

/// The pixel of a point in an image, and its distance to the camera center.
struct Projected {
    Eigen::Vector2d place_px;
    float distance = 0.0F;
};

/// Projects a position into a view. Empty if it is outside the image.
std::optional<Projected> project_into(const View& view, const Camera& camera,
                                      const Eigen::Vector3d& place);

/// A coarse z-buffer of a view: each square of its image keeps the distance of its nearest point.
class NearestGrid {
  public:
    /// Makes an empty grid. The point spacing in the image is estimated from every `stride`th of
    /// `places`, the positions of all points of `scene`. Precondition: the image size is known.
    NearestGrid(const View& view, const Scene& scene, const std::vector<Eigen::Vector3d>& places,
                std::size_t stride);

    /// Adds a point if it is in the image; it may hide others.
    void add(const Eigen::Vector3d& position);
    /// Whether a point is in the image, and no added point is clearly in front of it.
    bool sees(const Eigen::Vector3d& position) const;
    /// About the largest angle between two rays in one square, in radians.
    double square_angle() const { return square_angle_; }

  private:
    void lay_squares(double width, double share, double count);
    void set_depth(double steepest);
    double radians_a_pixel() const;

    const View& view_;
    const Camera& camera_;
    ImageSquares squares_;
    double square_angle_ = 0.0;
    float hides_from_ = 1.0F;  ///< points nearer than this fraction of a point's distance hide it
    std::vector<float> least_; ///< distance of the nearest point per square, row by row
};

} // namespace vcarve
