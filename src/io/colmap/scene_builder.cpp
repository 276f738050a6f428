#include "io/colmap/scene_builder.h"

#include "base/arrays.h"
#include "base/parallel.h"
#include "io/colmap/model_files.h"
#include "io/colmap/text_reader.h"
#include "model/scene_check.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// Sorts by id. Returns the first element whose successor has the same id, or the end.
template <typename Record>
auto sort_and_find_twice(std::vector<Record>& records)
{
    std::stable_sort(records.begin(), records.end(),
                     [](const Record& a, const Record& b) { return a.id < b.id; });
    return std::adjacent_find(records.begin(), records.end(),
                              [](const Record& a, const Record& b) { return a.id == b.id; });
}

constexpr std::uint32_t kNoView = 0xffffffffU;
constexpr std::uint32_t kInvalidImageId = 0xffffffffU; ///< COLMAP's, -1 as a signed number

std::string image_label(std::uint32_t id, std::string_view name)
{
    return fmt::format("image {} ({})", id, printable(name));
}

} // namespace

SceneBuilder::SceneBuilder(const std::filesystem::path& folder, ModelFormat format)
    : folder_(folder), format_(format)
{
}

void SceneBuilder::close_cameras()
{
    const auto twice = sort_and_find_twice(scene_.cameras);
    if (twice == scene_.cameras.end()) return;
    throw InputError(fmt::format("{}: camera {} occurs twice",
                                 model_path(folder_, "cameras", format_).string(), twice->id));
}

void SceneBuilder::add_image(const ImageRecord& image)
{
    const auto fail = [&](const std::string& finding) {
        throw InputError(fmt::format("{}: {} {}", model_path(folder_, "images", format_).string(),
                                     image_label(image.id, image.name), finding));
    };
    const auto camera =
        std::lower_bound(scene_.cameras.begin(), scene_.cameras.end(), image.camera_id,
                         [](const Camera& a, std::uint32_t id) { return a.id < id; });
    if (camera == scene_.cameras.end() || camera->id != image.camera_id) {
        fail(fmt::format("uses camera {}, which is missing in {}", image.camera_id,
                         model_file("cameras", format_)));
    }
    if (!image.rotation_wxyz.allFinite() || !image.translation.allFinite()) {
        fail("has a pose that is not finite");
    }
    const Eigen::Vector4d rotation = image.rotation_wxyz.stableNormalized();
    if (!(rotation.squaredNorm() > 0.5)) fail("has a rotation quaternion of length zero");

    file_ids_.push_back(image.id);
    View view;
    view.id = image.id;
    view.camera = static_cast<std::uint32_t>(camera - scene_.cameras.begin());
    view.name = image.name;
    view.cam_from_world = {rotation[0], rotation[1], rotation[2], rotation[3]};
    view.center = -(view.cam_from_world.conjugate() * image.translation);
    if (!is_valid_position(view.center)) fail("has a camera center too far from the origin");
    scene_.views.push_back(std::move(view));
}

void SceneBuilder::close_images()
{
    const auto twice = sort_and_find_twice(scene_.views);
    if (twice != scene_.views.end()) {
        throw InputError(fmt::format("{}: {} has the same id as {}",
                                     model_path(folder_, "images", format_).string(),
                                     image_label(std::next(twice)->id, std::next(twice)->name),
                                     image_label(twice->id, twice->name)));
    }
    image_ids_.reserve(scene_.views.size());
    for (const View& view : scene_.views) {
        image_ids_.push_back(view.id);
    }
}

void SceneBuilder::pass_on(std::size_t most, TakePoints take)
{
    most_ = most;
    take_ = std::move(take);
}

void SceneBuilder::reserve_points(std::size_t count, std::size_t rays)
{
    if (count > most_) {
        passed_ids_.reserve(count);
        rays = static_cast<std::size_t>(static_cast<double>(rays) * static_cast<double>(most_) /
                                        static_cast<double>(count));
        count = most_;
    }
    scene_.positions.reserve(count);
    scene_.colors.reserve(count);
    scene_.errors_px.reserve(count);
    scene_.point_ids.reserve(count);
    scene_.tracks.begins.reserve(count + 1);
    scene_.tracks.views.reserve(rays);
}

std::uint32_t SceneBuilder::view_index(std::uint32_t image_id) const
{
    // Ids rarely have gaps.
    const std::size_t guess = image_ids_.empty() ? 0 : image_id - image_ids_.front();
    if (guess < image_ids_.size() && image_ids_[guess] == image_id) {
        return static_cast<std::uint32_t>(guess);
    }
    const auto found = std::lower_bound(image_ids_.begin(), image_ids_.end(), image_id);
    if (found == image_ids_.end() || *found != image_id) return kNoView;
    return static_cast<std::uint32_t>(found - image_ids_.begin());
}

void SceneBuilder::add_point(const PointRecord& point, std::span<const std::uint32_t> image_ids)
{
    row_.clear();
    for (const std::uint32_t image_id : image_ids) {
        const std::uint32_t view = view_index(image_id);
        if (view != kNoView) {
            row_.push_back(view);
        } else if (image_id != 0 && image_id != kInvalidImageId) {
            ++dropped_.rays;
            dropped_.images.insert(image_id);
        }
    }
    sort_unique(row_);

    const std::vector<std::uint64_t>& ids =
        scene_.point_ids.empty() ? passed_ids_ : scene_.point_ids;
    point_ids_ascend_ = point_ids_ascend_ && (ids.empty() || ids.back() < point.id);
    scene_.positions.push_back(position_or_nan(point.position));
    scene_.colors.push_back(point.color);
    scene_.errors_px.push_back(std::isnan(point.error_px) ? -1.0 : point.error_px);
    scene_.point_ids.push_back(point.id);
    scene_.tracks.push_back(row_);
    if (scene_.num_points() == most_) pass_points_on();
}

void SceneBuilder::pass_points_on()
{
    Scene part;
    std::swap(part, scene_);
    scene_.cameras = std::move(part.cameras);
    scene_.views = std::move(part.views);
    passed_ids_.insert(passed_ids_.end(), part.point_ids.begin(), part.point_ids.end());
    take_(std::move(part));
}

void SceneBuilder::refuse_point_ids_twice()
{
    if (point_ids_ascend_) return;
    std::vector<std::uint64_t> ids = std::move(passed_ids_);
    ids.insert(ids.end(), scene_.point_ids.begin(), scene_.point_ids.end());
    parallel_sort(ids);
    const auto twice = std::adjacent_find(ids.begin(), ids.end());
    if (twice == ids.end()) return;
    throw InputError(fmt::format("{}: point {} occurs twice",
                                 model_path(folder_, "points3D", format_).string(), *twice));
}

Scene SceneBuilder::finish()
{
    if (take_) pass_points_on();
    refuse_point_ids_twice();
    return std::move(scene_);
}

ColmapViews SceneBuilder::finish_views()
{
    ColmapViews found;
    for (const std::uint32_t id : file_ids_) {
        const auto view = std::lower_bound(image_ids_.begin(), image_ids_.end(), id);
        found.file_order.push_back(static_cast<std::uint32_t>(view - image_ids_.begin()));
    }
    found.cameras = std::move(scene_.cameras);
    found.views = std::move(scene_.views);
    return found;
}

} // namespace vcarve
