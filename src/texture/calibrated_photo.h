#pragma once

#include "model/photograph.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// A photograph of a view: how a place comes to its pixels, whose number may differ from what the
/// camera says, as after the photographs were made smaller.
struct CalibratedPhoto {
    std::filesystem::path file;
    std::filesystem::path mask; ///< its black pixels are excluded; empty: none
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

/// Whether a mask excludes a pixel, as in COLMAP: whether it is black there.
bool is_excluded(const Photograph& mask, const Eigen::Vector2d& pixel);

/// Makes the pixels of a photograph transparent that a mask, which may have another size, excludes.
/// Throws InputError as read_photograph() does.
void exclude_masked(const std::filesystem::path& mask_file, Photograph& photo);

/// Reads a photograph and its mask. If either cannot be read, the result shows nothing, and
/// `problem` says why.
Photograph photograph_of(const CalibratedPhoto& photo, std::string& problem);

/// Every square of 2 x 2 pixels made one, which shows nothing if one of them does not; an odd row
/// or column at the end is left out.
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

    /// Whether all pixels that at() blends show something.
    bool shows(const Eigen::Vector2d& pixel, double width_px = 1.0) const;

  private:
    /// The level for a width, and its pixels per pixel of the photograph.
    std::pair<const Photograph*, double> level_of(double width_px) const;

    std::vector<Photograph> levels_;
};

} // namespace vcarve
