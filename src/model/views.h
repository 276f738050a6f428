#pragma once

#include "vcarve/scene.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <span>
#include <vector>

namespace vcarve {

/// Whether a track contains a scanner. The range of the point was then measured, which is as good
/// as further views.
inline bool has_measured_range(const Scene& scene, std::span<const std::uint32_t> track)
{
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return scene.cameras[scene.views[view].camera].measures_range;
    });
}

/// Whether a scene has scanner views.
inline bool has_scanners(const Scene& scene)
{
    return std::ranges::any_of(
        scene.views, [&](const View& view) { return scene.cameras[view.camera].measures_range; });
}

/// The sum of the unit vectors from a point to the views that saw it.
inline Eigen::Vector3d towards_views(const Scene& scene, std::size_t point)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t view : scene.tracks[point]) {
        sum += (scene.views[view].center - scene.positions[point]).normalized();
    }
    return sum;
}

/// The normalized mean of direction(view), a unit vector, over all views. Returns nothing if the
/// mean is not longer than `agreeing`, for example because the directions cancel out.
template <typename Direction>
std::optional<Eigen::Vector3d> mean_direction(const Scene& scene, const Direction& direction,
                                              double agreeing = 0.1)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const View& view : scene.views) {
        sum += direction(view);
    }
    if (!(sum.norm() > agreeing * static_cast<double>(scene.views.size()))) return std::nullopt;
    return sum.normalized();
}

/// The upward direction, unit. COLMAP does not provide it. This is the mean upward direction of the
/// cameras, or back_of() if these directions cancel out. For laser scans it is z.
Eigen::Vector3d up_of(const Scene& scene);

/// The mean backward direction of the cameras, unit: up if they look down. Returns nothing if they
/// look in all directions.
std::optional<Eigen::Vector3d> back_of(const Scene& scene);

/// Whether the cameras look in nearly the same direction: their images may be upright, or taken
/// straight down.
bool look_in_one_direction(const Scene& scene);

/// The inverse of rows of views: the occurrences of each view in the rows.
class PlacesOfViews {
  public:
    struct Entry {
        std::uint32_t row;
        std::uint32_t number; ///< position in the row
    };

    /// row_of(i) is the i-th row, a span of views. Cost: O(rows + their total length).
    template <typename RowOf>
    PlacesOfViews(std::size_t num_rows, std::size_t num_views, const RowOf& row_of)
        : begins_(num_views + 1)
    {
        for (std::size_t i = 0; i < num_rows; ++i) {
            for (const std::uint32_t view : row_of(i)) {
                ++begins_[view + 1];
            }
        }
        std::partial_sum(begins_.begin(), begins_.end(), begins_.begin());
        places_.resize(begins_.back());
        std::vector<std::size_t> next = begins_;
        for (std::uint32_t i = 0; i < num_rows; ++i) {
            std::uint32_t number = 0;
            for (const std::uint32_t view : row_of(i)) {
                places_[next[view]++] = {i, number++};
            }
        }
    }

    /// The occurrences of a view, by ascending row.
    std::span<const Entry> of(std::size_t view) const
    {
        return std::span(places_).subspan(begins_[view], begins_[view + 1] - begins_[view]);
    }

  private:
    std::vector<std::size_t> begins_; ///< places_[begins_[v]] is the first entry of view v
    std::vector<Entry> places_;
};

/// The cell centers of a grid of nearly square cells over a camera's image, in pixels: at least
/// one, at most `most` (1 or more). Empty if the image size is unknown.
std::vector<Eigen::Vector2d> pixel_grid(const Camera& camera, std::size_t most);

/// The covariance of a point for errors of one pixel in each image, in squared scene units
/// (backward propagation, Hartley & Zisserman 2004, 5.2). The ellipsoid is long if the rays meet at
/// small angles. Zero if the rays do not cross. A scanner's range has the error that a pixel covers
/// at that distance. `focals_px` is mean_focals_px() of the cameras. Cost: O(rays of the point).
Eigen::Matrix3d covariance_of_a_pixel(const Scene& scene, std::size_t point,
                                      const std::vector<double>& focals_px);

} // namespace vcarve
