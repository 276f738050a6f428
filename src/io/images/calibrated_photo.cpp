#include "io/images/calibrated_photo.h"

#include "io/images/read_photograph.h"
#include "model/camera.h"
#include "model/photograph.h"
#include "vcarve/error.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace vcarve {

std::vector<CalibratedPhoto> calibrated_photos(const Scene& scene, const Photographs& photographs,
                                               const Eigen::Vector3d& mesh_offset)
{
    std::vector<CalibratedPhoto> photos;
    const std::vector<double> focals_px = mean_focals_px(scene.cameras);
    for (std::uint32_t i = 0; i < scene.views.size(); ++i) {
        const View& view = scene.views[i];
        const Camera& camera = scene.cameras[view.camera];
        if (photographs.of_view[i].empty() || !project(camera, Eigen::Vector3d::UnitZ()) ||
            camera.width_px == 0 || camera.height_px == 0) {
            continue;
        }
        CalibratedPhoto& photo = photos.emplace_back();
        photo.file = photographs.of_view[i];
        if (!photographs.masks.empty()) photo.mask = photographs.masks[i];
        photo.size = photographs.sizes[i];
        photo.view = i;
        photo.pose = view;
        photo.pose.center += scene.offset - mesh_offset;
        photo.camera = camera;
        photo.scale = {photo.size.width_px / static_cast<double>(camera.width_px),
                       photo.size.height_px / static_cast<double>(camera.height_px)};
        photo.focal_px = focals_px[view.camera] * photo.scale.mean();
    }
    return photos;
}

std::optional<Eigen::Vector2d> pixel_beyond(const CalibratedPhoto& photo,
                                            const Eigen::Vector3d& position)
{
    const Eigen::Vector3d in_cam = photo.pose.cam_from_world * (position - photo.pose.center);
    std::optional<Eigen::Vector2d> pixel = project(photo.camera, in_cam);
    if (pixel) pixel->array() *= photo.scale;
    return pixel;
}

std::optional<Eigen::Vector2d> pixel_of(const CalibratedPhoto& photo,
                                        const Eigen::Vector3d& position)
{
    const std::optional<Eigen::Vector2d> pixel = pixel_beyond(photo, position);
    const bool is_inside = pixel && pixel->x() >= 0.0 && pixel->y() >= 0.0 &&
                           pixel->x() <= photo.size.width_px && pixel->y() <= photo.size.height_px;
    return is_inside ? pixel : std::nullopt;
}

bool is_excluded(const Photograph& mask, const Eigen::Vector2d& pixel)
{
    const int x = std::min(static_cast<int>(pixel.x()), mask.width_px - 1);
    const int y = std::min(static_cast<int>(pixel.y()), mask.height_px - 1);
    const std::uint8_t* const at =
        mask.rgb.data() + 3 * (static_cast<std::size_t>(y) * mask.width_px + x);
    return at[0] == 0 && at[1] == 0 && at[2] == 0;
}

void exclude_masked(const std::filesystem::path& mask_file, Photograph& photo)
{
    const Photograph mask = read_photograph(mask_file);
    if (photo.alpha.empty()) photo.alpha.assign(photo.rgb.size() / 3, 255);
    const double right = static_cast<double>(mask.width_px) / photo.width_px;
    const double down = static_cast<double>(mask.height_px) / photo.height_px;
    auto alpha = photo.alpha.begin();
    for (int y = 0; y < photo.height_px; ++y) {
        for (int x = 0; x < photo.width_px; ++x, ++alpha) {
            if (is_excluded(mask, {right * (x + 0.5), down * (y + 0.5)})) *alpha = 0;
        }
    }
}

Photograph photograph_of(const CalibratedPhoto& photo, std::string& problem)
{
    try {
        Photograph read = read_photograph(photo.file);
        if (!photo.mask.empty()) exclude_masked(photo.mask, read);
        return read;
    } catch (const InputError& error) {
        problem = error.what();
        const auto pixels = static_cast<std::size_t>(photo.size.width_px) * photo.size.height_px;
        return {photo.size.width_px, photo.size.height_px, std::vector<std::uint8_t>(3 * pixels),
                std::vector<std::uint8_t>(pixels)};
    }
}

Photograph halved(const Photograph& whole)
{
    Photograph half{std::max(1, whole.width_px / 2), std::max(1, whole.height_px / 2), {}};
    half.rgb.resize(static_cast<std::size_t>(3) * half.width_px * half.height_px);
    const auto row_bytes = static_cast<std::size_t>(3) * whole.width_px;
    const std::size_t right = whole.width_px > 1 ? 3 : 0;
    const std::size_t below = whole.height_px > 1 ? row_bytes : 0;
    std::size_t to = 0;
    for (int y = 0; y < half.height_px; ++y) {
        const std::uint8_t* from = whole.rgb.data() + 2 * row_bytes * y;
        for (int x = 0; x < half.width_px; ++x, from += 6) {
            for (int channel = 0; channel < 3; ++channel, ++to) {
                const std::uint8_t* at = from + channel;
                half.rgb[to] = static_cast<std::uint8_t>(
                    (at[0] + at[right] + at[below] + at[right + below] + 2) / 4);
            }
        }
    }
    if (whole.alpha.empty()) return half;
    for (int y = 0; y < half.height_px; ++y) {
        for (int x = 0; x < half.width_px; ++x) {
            const std::size_t at = 2 * (static_cast<std::size_t>(y) * whole.width_px + x);
            half.alpha.push_back(
                std::min({whole.alpha[at], whole.alpha[at + right / 3], whole.alpha[at + below / 3],
                          whole.alpha[at + (right + below) / 3]}));
        }
    }
    return half;
}

PhotoPyramid::PhotoPyramid(Photograph photograph)
{
    levels_.push_back(std::move(photograph));
    while (std::min(levels_.back().width_px, levels_.back().height_px) > 1) {
        levels_.push_back(halved(levels_.back()));
    }
}

std::pair<const Photograph*, double> PhotoPyramid::level_of(double width_px) const
{
    const double finest = std::round(std::log2(std::max(width_px, 1.0)));
    const auto level = std::min(static_cast<std::size_t>(finest), levels_.size() - 1);
    return {&levels_[level], 1.0 / static_cast<double>(std::size_t{1} << level)};
}

Eigen::Array3f PhotoPyramid::at(const Eigen::Vector2d& pixel, double width_px) const
{
    const auto [level, scale] = level_of(width_px);
    return between_pixels(*level, scale * pixel);
}

bool PhotoPyramid::shows(const Eigen::Vector2d& pixel, double width_px) const
{
    if (levels_[0].alpha.empty()) return true;
    const auto [level, scale] = level_of(width_px);
    const int left = static_cast<int>(std::floor(scale * pixel.x() - 0.5));
    const int top = static_cast<int>(std::floor(scale * pixel.y() - 0.5));
    for (const auto& [right, below] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        const int x = std::clamp(left + right, 0, level->width_px - 1);
        const int y = std::clamp(top + below, 0, level->height_px - 1);
        if (level->alpha[static_cast<std::size_t>(y) * level->width_px + x] == 0) return false;
    }
    return true;
}

} // namespace vcarve
