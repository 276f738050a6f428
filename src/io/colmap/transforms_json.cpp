// Format: https://docs.nerf.studio/quickstart/data_conventions.html. Poses map from the camera (x
// right, y up, z backwards) to the world. Lens parameters of the file apply to all images that have
// none. `applied_transform` is already part of poses and points, so readers of both ignore it.

#include "io/colmap/transforms_json.h"

#include "io/colmap/colmap_formats.h"
#include "io/colmap/model_files.h"
#include "io/colmap/text_reader.h"
#include "io/files/mapped_file.h"
#include "io/images/read_photograph.h"
#include "model/lens.h"
#include "model/similarity.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <string_view>
#include <system_error>

namespace vcarve {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// A JSON value, or null if it is missing, and its path for messages.
struct Place {
    const fs::path& file;
    std::string name;
    const Json* value;

    [[noreturn]] void refuse(std::string_view found, std::string_view expected) const
    {
        throw InputError(fmt::format("{}: {}: found {}, expected {}", file.string(),
                                     name.empty() ? "the file" : name, found, expected));
    }
    [[noreturn]] void refuse(std::string_view expected) const
    {
        if (value == nullptr) refuse("nothing", expected);
        const bool is_short = value->is_primitive();
        refuse(is_short ? printable(value->dump(-1, ' ', false, Json::error_handler_t::replace))
                        : fmt::format("an {} of size {}", value->type_name(), value->size()),
               expected);
    }
    Place member(const std::string& key) const
    {
        const std::string path = name.empty() ? key : name + "." + key;
        const bool has_it = value->is_object() && value->contains(key);
        return {file, path, has_it ? &value->at(key) : nullptr};
    }
    Place entry(std::size_t i) const
    {
        return {file, fmt::format("{}[{}]", name, i), &value->at(i)};
    }
    bool is_array() const { return value != nullptr && value->is_array(); }
    double number(std::string_view expected) const
    {
        if (value == nullptr || !value->is_number()) refuse(expected);
        return value->get<double>();
    }
    std::string text(std::string_view expected) const
    {
        if (value == nullptr || !value->is_string()) refuse(expected);
        return value->get<std::string>();
    }
};

/// Throws an error with the position of the first invalid JSON.
[[noreturn]] void refuse_text(const fs::path& path, std::string_view text, std::size_t byte)
{
    const std::size_t at = std::min(byte, text.size());
    const std::string_view before = text.substr(0, at);
    const auto line = 1 + std::ranges::count(before, '\n');
    const std::size_t begin = before.find_last_of('\n') + 1; // npos + 1 is 0
    constexpr std::size_t kShown = 40;
    const std::size_t from = std::max(begin, at > kShown ? at - kShown : 0);
    throw InputError(
        fmt::format("{}: line {}: invalid JSON after '{}', expected a transforms.json as "
                    "nerfstudio and instant-ngp write it",
                    path.string(), line, printable(text.substr(from, at - from))));
}

Json parse(const fs::path& path)
{
    constexpr int kDeepest = 64; // a pose is five deep
    const MappedFile file(path);
    const std::string_view text(file.bytes().data(), file.bytes().size());
    const auto is_shallow = [&](int depth, Json::parse_event_t /*event*/, Json& /*value*/) {
        if (depth <= kDeepest) return true;
        throw InputError(fmt::format("{}: its values are nested more than {} levels deep, expected "
                                     "a transforms.json as nerfstudio and instant-ngp write it",
                                     path.string(), kDeepest));
    };
    try {
        return Json::parse(text, is_shallow);
    } catch (const Json::parse_error& error) {
        refuse_text(path, text, error.byte);
    } catch (const Json::exception&) { // a number outside the range of double
        throw InputError(fmt::format("{}: contains a number that is too large", path.string()));
    }
}

/// JSON files of other programs, recognized by a key of the file or of its first entry.
constexpr struct {
    const char* key;
    const char* sentence;
} kOthers[] = {
    {"img_name",
     "camera lists of 3D Gaussian splatting are not supported; give the COLMAP model that was "
     "used for training (source_path in cfg_args), and its Gaussians as --points "
     "point_cloud/iteration_30000/point_cloud.ply"},
    {"shots", "reconstructions of OpenSfM are not supported; run: opensfm export_colmap DATASET, "
              "and give the exported folder"},
    {"sfm_data_version", "scenes of OpenMVG are not supported; run: openMVG_main_openMVG2Colmap -i "
                         "{} -o FOLDER, and give FOLDER"}};

/// The value of `frames`. Throws if it is not an array with at least one entry.
Place frames_of(const Json& json, const fs::path& path)
{
    const Json& first = json.is_array() && !json.empty() ? json.front() : json;
    for (const auto& [key, sentence] : kOthers) {
        if (!first.contains(key)) continue;
        throw InputError(path.string() + ": " + fmt::format(fmt::runtime(sentence), path.string()));
    }
    Place frames = Place{path, "", &json}.member("frames");
    if (!frames.is_array() || frames.value->empty()) {
        frames.refuse("a list of images with their poses, as nerfstudio and instant-ngp write it");
    }
    return frames;
}

std::string name_of(const Place& frame)
{
    return frame.member("file_path").text("the name of the image");
}

/// The lens parameters of an image: its own, or else those for all images.
class Lens {
  public:
    Lens(const Place& all, const Place& frame) : all_(all), frame_(frame) {}

    Camera camera() const
    {
        Camera camera;
        camera.width_px = size_px("w", &PhotographSize::width_px);
        camera.height_px = size_px("h", &PhotographSize::height_px);
        const auto width = static_cast<double>(camera.width_px);
        const auto height = static_cast<double>(camera.height_px);
        const double focal_x = focal_px("fl_x", "camera_angle_x", width, 0.0);
        const double focal_y = focal_px("fl_y", "camera_angle_y", height, focal_x);
        camera.params = {focal_x, focal_y, number_or("cx", 0.5 * width),
                         number_or("cy", 0.5 * height)};
        add_distortion(camera);
        return camera;
    }

  private:
    Place at(const std::string& key) const
    {
        const Place own = frame_.member(key);
        const Place shared = all_.member(key);
        return own.value == nullptr && shared.value != nullptr ? shared : own;
    }

    double number_or(const std::string& key, double other) const
    {
        const Place place = at(key);
        return place.value == nullptr ? other : place.number("a number");
    }

    /// The size of the frame's photograph. Its name may lack the extension, as in Blender's scenes.
    PhotographSize picture_size(const Place& missing) const
    {
        for (const char* const end : {"", ".png", ".jpg", ".jpeg"}) {
            const fs::path file = frame_.file.parent_path() / (name_of(frame_) + end);
            if (is_file(file)) return photograph_size(file);
        }
        missing.refuse("the size of the images in pixels, or the image itself");
    }

    std::uint64_t size_px(const std::string& key, int PhotographSize::*side) const
    {
        constexpr const char* kExpected = "the size of the images in pixels";
        const Place place = at(key);
        if (place.value == nullptr) return static_cast<std::uint64_t>(picture_size(place).*side);
        const double size = place.number(kExpected);
        if (!(size >= 1.0 && size <= 1e9) || size != std::floor(size)) place.refuse(kExpected);
        return static_cast<std::uint64_t>(size);
    }

    /// The focal length in px: given, or computed from the angle of view, or `other` if above 0.
    double focal_px(const char* key, const char* angle, double size_px, double other) const
    {
        const Place focal = at(key);
        const Place spans = at(angle);
        if (focal.value == nullptr && spans.value != nullptr) {
            const double radians = spans.number("an angle in radians");
            if (radians > 0.0 && radians < std::numbers::pi) {
                return 0.5 * size_px / std::tan(0.5 * radians);
            }
            spans.refuse("an angle in radians, between 0 and pi");
        }
        if (focal.value == nullptr && other > 0.0) return other;
        const std::string expected =
            fmt::format("the focal length in pixels, above 0, or else {}", angle);
        const double length = focal.number(expected);
        if (!(length > 0.0)) focal.refuse(expected);
        return length;
    }

    bool is_fisheye() const
    {
        constexpr std::array kPerspective = {"PINHOLE", "SIMPLE_PINHOLE", "SIMPLE_RADIAL",
                                             "RADIAL",  "OPENCV",         "PERSPECTIVE"};
        const Place model = at("camera_model");
        if (model.value == nullptr) {
            const Place flag = at("is_fisheye");
            return flag.value != nullptr && *flag.value == true;
        }
        constexpr const char* kExpected = "PINHOLE, OPENCV or OPENCV_FISHEYE";
        const std::string name = model.text(kExpected);
        if (name == "OPENCV_FISHEYE") return true;
        if (std::ranges::count(kPerspective, name) == 0) model.refuse(kExpected);
        return false;
    }

    /// Ignores nerfstudio's k4 of perspective lenses, because COLMAP's lenses lack it.
    void add_distortion(Camera& camera) const
    {
        const auto take = [&](std::initializer_list<const char*> keys) {
            for (const char* const key : keys) {
                camera.params.push_back(number_or(key, 0.0));
            }
        };
        const std::size_t num_pinhole = camera.params.size();
        const bool fisheye = is_fisheye();
        fisheye ? take({"k1", "k2", "k3", "k4"}) : take({"k1", "k2", "p1", "p2", "k3"});
        const bool is_plain =
            std::all_of(camera.params.begin() + static_cast<std::ptrdiff_t>(num_pinhole),
                        camera.params.end(), [](double parameter) { return parameter == 0.0; });
        const bool is_pinhole = is_plain && !fisheye;
        const LensModel* const model = lens_model(std::string_view(fisheye      ? "OPENCV_FISHEYE"
                                                                   : is_pinhole ? "PINHOLE"
                                                                                : "FULL_OPENCV"));
        camera.model = model->number;
        camera.params.resize(model->num_params);
    }

    const Place& all_;
    const Place& frame_;
};

bool are_same(const Camera& a, const Camera& b)
{
    return a.model == b.model && a.width_px == b.width_px && a.height_px == b.height_px &&
           a.params == b.params;
}

/// The camera of each frame. Consecutive frames with equal parameters share one.
std::vector<Camera> cameras_of(const Json& json, const Place& frames)
{
    const Place all{frames.file, "", &json};
    std::vector<Camera> cameras;
    for (std::size_t i = 0; i < frames.value->size(); ++i) {
        const Place frame = frames.entry(i);
        Camera camera = Lens(all, frame).camera();
        camera.id = 1;
        if (!cameras.empty()) {
            camera.id = cameras.back().id + (are_same(camera, cameras.back()) ? 0 : 1);
        }
        cameras.push_back(std::move(camera));
    }
    return cameras;
}

/// Reads a similarity from 3 or 4 rows of 4 numbers.
Matrix34 matrix_in(const Place& rows, const char* expected)
{
    if (!rows.is_array() || rows.value->size() < 3 || rows.value->size() > 4) {
        rows.refuse(expected);
    }
    Matrix34 pose;
    for (int r = 0; r < 3; ++r) {
        const Place row = rows.entry(static_cast<std::size_t>(r));
        if (!row.is_array() || row.value->size() != 4) row.refuse(expected);
        for (int c = 0; c < 4; ++c) {
            pose(r, c) = row.entry(static_cast<std::size_t>(c)).number("a number");
        }
    }
    const std::string fault = fault_of_similarity(pose);
    if (!fault.empty()) rows.refuse(fault, expected);
    return pose;
}

void read_frame_cameras(const fs::path& path, SceneBuilder& builder)
{
    const Json json = parse(path);
    std::uint32_t last = 0;
    for (Camera& camera : cameras_of(json, frames_of(json, path))) {
        if (camera.id == last) continue;
        last = camera.id;
        builder.add_camera(std::move(camera));
    }
    builder.close_cameras();
}

void read_frame_images(const fs::path& path, SceneBuilder& builder, const Progress& /*progress*/)
{
    const Json json = parse(path);
    const Place frames = frames_of(json, path);
    const std::vector<Camera> cameras = cameras_of(json, frames);
    for (std::size_t i = 0; i < cameras.size(); ++i) {
        const Place frame = frames.entry(i);
        const Similarity pose =
            similarity_of(matrix_in(frame.member("transform_matrix"),
                                    "a pose: 4 rows of 4 numbers, from the camera to the world"));
        // The axes of transforms.json have y up and z backwards
        const Eigen::Matrix3d world_from_cam =
            pose.linear / pose.scale * Eigen::Vector3d(1, -1, -1).asDiagonal();
        const Eigen::Quaterniond rotation(Eigen::Matrix3d(world_from_cam.transpose()));
        const std::string name = fs::path(name_of(frame)).lexically_normal();
        builder.add_image(
            {.id = static_cast<std::uint32_t>(i + 1),
             .rotation_wxyz = {rotation.w(), rotation.x(), rotation.y(), rotation.z()},
             .translation = -(rotation.normalized() * pose.translation),
             .camera_id = cameras[i].id,
             .name = name});
    }
    builder.close_images();
}

} // namespace

const FormatReader kTransformsReader = {read_frame_cameras, read_frame_images, nullptr, nullptr};

fs::path points_of_transforms(const fs::path& file)
{
    const Json json = parse(file);
    frames_of(json, file); // throws for any other file
    const Place named = Place{file, "", &json}.member("ply_file_path");
    const fs::path folder = file.parent_path();
    if (named.value != nullptr) return folder / named.text("the path of a PLY file");
    for (const char* const name : {kSparsePly, kPointsPly}) {
        if (is_file(folder / name)) return folder / name;
    }
    return {};
}

Similarity read_nerfstudio_transform(const fs::path& file, const fs::path& poses)
{
    constexpr const char* kExpected = "a matrix of 3 rows of 4 numbers";
    const Json json = parse(file);
    const Place all{file, "", &json};
    const Place scale = all.member("scale");
    const double factor = scale.number("the scale of nerfstudio");
    if (!(factor > 0.0)) scale.refuse("a scale above 0");
    Eigen::AffineCompact3d to;
    to.matrix() = factor * matrix_in(all.member("transform"), kExpected);
    const Json saved = poses.empty() ? Json() : parse(poses);
    const Place applied = Place{poses, "", &saved}.member("applied_transform");
    if (applied.value == nullptr) return similarity_of(to.matrix());
    Eigen::AffineCompact3d first;
    first.matrix() = matrix_in(applied, kExpected);
    return similarity_of((to * first.inverse()).matrix());
}

} // namespace vcarve
