#pragma once

#include "io/images/find_photographs.h"
#include "model/photograph.h"
#include "vcarve/scene.h"

#include <Eigen/Core>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// A photograph of a view with its calibration. Its size may differ from the camera's, for instance
/// if the photographs were scaled down.
struct CalibratedPhoto {
    std::filesystem::path file;
    std::filesystem::path mask; ///< image whose black pixels are excluded; empty: no mask
    PhotographSize size;
    std::uint32_t view = 0;         ///< index into Scene::views
    View pose;                      ///< center in the frame of the mesh
    double focal_px = 0.0;          ///< mean of both axes, in photograph pixels
    Camera camera;                  ///< as in the model
    Eigen::Array2d scale{1.0, 1.0}; ///< photograph pixels per camera pixel
};

/// Returns the photographs of a scene's views, in the frame of a mesh. Skips views without a
/// photograph or with an unknown lens.
std::vector<CalibratedPhoto> calibrated_photos(const Scene& scene, const Photographs& photographs,
                                               const Eigen::Vector3d& mesh_offset);

/// Projects a position in the frame of the mesh to a pixel; the first pixel's center is (0.5, 0.5).
/// Returns nothing if the photograph does not show it. Cost: as project().
std::optional<Eigen::Vector2d> pixel_of(const CalibratedPhoto& photo,
                                        const Eigen::Vector3d& position);

/// Like pixel_of(), but also returns pixels beyond the photograph's edges.
std::optional<Eigen::Vector2d> pixel_beyond(const CalibratedPhoto& photo,
                                            const Eigen::Vector3d& position);

/// Whether a mask excludes a pixel, as in COLMAP: if it is black.
bool is_excluded(const Photograph& mask, const Eigen::Vector2d& pixel);

/// Makes the pixels that a mask excludes transparent. The mask may have another size than the
/// photograph. Throws InputError like read_photograph().
void exclude_masked(const std::filesystem::path& mask_file, Photograph& photo);

/// Reads a photograph and its mask. If either is unreadable, returns a transparent photograph and
/// sets `problem` to the error message.
Photograph photograph_of(const CalibratedPhoto& photo, std::string& problem);

/// Averages every 2 x 2 pixels to one; a transparent pixel makes the result transparent. Drops an
/// odd last row or column.
Photograph halved(const Photograph& photograph);

/// A photograph with its halves, quarters and so on, for mean colors around pixels. Needs a third
/// more memory than the photograph.
class PhotoPyramid {
  public:
    explicit PhotoPyramid(Photograph photograph);

    /// The mean color of about `width_px` x `width_px` pixels, in levels of 0 to 255. Interpolates
    /// bilinearly in the level whose pixels are about that large. Beyond the edges, the color at
    /// the edge is used.
    Eigen::Array3f at(const Eigen::Vector2d& pixel, double width_px = 1.0) const;

    /// Whether no pixel that at() blends is transparent.
    bool shows(const Eigen::Vector2d& pixel, double width_px = 1.0) const;

  private:
    /// The level for a width, and its number of pixels per photograph pixel, along a side.
    std::pair<const Photograph*, double> level_of(double width_px) const;

    std::vector<Photograph> levels_;
};

} // namespace vcarve
