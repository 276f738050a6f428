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

    /// So many times as wide as so many points stand apart in a share of the image; but at most as
    /// many along an edge as points, whatever size an image claims to have.
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

    /// Whether is_so(square) of a square or one of the eight around it.
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
