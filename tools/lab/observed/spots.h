#pragma once

#include "random.h"
#include "render/parts.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

namespace vcarve::observed {

/// A place on the true surface.
struct Spot {
    Eigen::Vector3d position;
    Eigen::Vector3d normal;
    render::Paint paint;
};

/// What places are as many of: a matcher finds features by area and contrast, stereo depths by
/// area alone.
enum class Spread { area_and_contrast, area };

/// Draws places on a surface.
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
    std::vector<double> sums_; ///< of what places are drawn by, up to each face
};

} // namespace vcarve::observed
