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

/// Whether one of some views is a scanner: then the range of a point that they saw was measured,
/// and is as well known as if other views had seen the point, too.
inline bool has_measured_range(const Scene& scene, std::span<const std::uint32_t> track)
{
    return std::any_of(track.begin(), track.end(), [&](std::uint32_t view) {
        return scene.cameras[scene.views[view].camera].measures_range;
    });
}

/// Whether a scene has a scanner among its views.
inline bool has_scanners(const Scene& scene)
{
    return std::ranges::any_of(
        scene.views, [&](const View& view) { return scene.cameras[view.camera].measures_range; });
}

/// Where the views that saw a point are, all taken together: the sum of the unit vectors to them.
inline Eigen::Vector3d towards_views(const Scene& scene, std::size_t point)
{
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const std::uint32_t view : scene.tracks[point]) {
        sum += (scene.views[view].center - scene.positions[point]).normalized();
    }
    return sum;
}

/// The mean direction of the views by direction(view), unit vectors; nothing if the mean of these
/// is not longer than `agreeing`, as where they cancel out.
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

/// The direction that is up, unit. COLMAP does not know it: it is the mean of the upward directions
/// of the cameras; where these cancel out, the mean direction they look back along; z of a laser
/// scan.
Eigen::Vector3d up_of(const Scene& scene);

/// The mean direction the cameras look back along, unit: up where they look down. Nothing where
/// they look in all directions.
std::optional<Eigen::Vector3d> back_of(const Scene& scene);

/// Whether all cameras look in nearly one direction, so that their images may be upright or taken
/// straight down.
bool look_one_way(const Scene& scene);

/// Where the views stand in rows of them, view by view.
class PlacesOfViews {
  public:
    struct Entry {
        std::uint32_t row;
        std::uint32_t number; ///< in the row
    };

    /// Of rows of which the i-th is row_of(i), a span of views. Cost: O(rows + places).
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

    /// Of a view, by ascending rows.
    std::span<const Entry> of(std::size_t view) const
    {
        return std::span(places_).subspan(begins_[view], begins_[view + 1] - begins_[view]);
    }

  private:
    std::vector<std::size_t> begins_; ///< a view's are places_[begins_[view]] up to the next one's
    std::vector<Entry> places_;
};

/// The middles of a grid of about square cells over a camera's images, in pixels: at most `most` of
/// them but at least one. None where the size of the images is not known. `most` is 1 or more.
std::vector<Eigen::Vector2d> pixel_grid(const Camera& camera, std::size_t most);

/// How uncertain a point is if its place in each image is in error by one pixel, in squares of
/// scene units: its sights meet in an ellipsoid that is long where they meet at small angles
/// (covariance by backward propagation, Hartley & Zisserman 2004, 5.2). Zero where they do not
/// cross. Of a scanner's sight the range is in error, too, by as much as a pixel covers there.
/// `focals_px` are mean_focals_px() of the cameras. Cost: O(sights of the point).
Eigen::Matrix3d covariance_of_a_pixel(const Scene& scene, std::size_t point,
                                      const std::vector<double>& focals_px);

} // namespace vcarve
