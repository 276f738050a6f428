#pragma once

#include "model/photograph.h"

#include <Eigen/Core>

#include <vector>

namespace vcarve {

/// Every square of 2 x 2 pixels made one; an odd row or column at the end is left out.
Photograph halved(const Photograph& photograph);

/// A photograph with its halves, quarters and so on, to be asked for the mean colour around a
/// pixel. A third more memory than the photograph's.
class PhotoPyramid {
  public:
    explicit PhotoPyramid(Photograph photograph);

    /// The colour, each channel from 0 to 255, around a pixel, averaged over about so many pixels
    /// a side: bilinear between the pixels of the level whose pixels are as large. Beyond the edges
    /// the photograph goes on with the colours there.
    Eigen::Array3f at(const Eigen::Vector2d& pixel, double width_px = 1.0) const;

  private:
    std::vector<Photograph> levels_;
};

} // namespace vcarve
