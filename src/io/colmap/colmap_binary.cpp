// Layout: https://colmap.github.io/format.html, unchanged since 2016. Each file has a count
// (uint64) and that many records, without padding.

#include "io/colmap/byte_reader.h"
#include "io/colmap/colmap_formats.h"
#include "io/colmap/model_files.h"
#include "io/files/mapped_file.h"
#include "model/lens.h"
#include "vcarve/error.h"

#include <fmt/format.h>

namespace vcarve {

namespace {

constexpr std::size_t kCameraBytes = 4 + 4 + 8 + 8;        // without parameters
constexpr std::size_t kImageBytes = 4 + 7 * 8 + 4 + 1 + 8; // with an empty name and no 2D points
constexpr std::size_t kPoint2dBytes = 2 * 8 + 8;           // x, y, point id
constexpr std::size_t kTrackElementBytes = 4 + 4;          // image id, index of the 2D point

Camera read_camera(ByteReader& reader, const std::string& name)
{
    Camera camera;
    camera.id = reader.read<std::uint32_t>("the id of a camera");
    camera.model = reader.read<std::int32_t>("the model of a camera");
    const LensModel* model = lens_model(camera.model);
    if (model == nullptr) {
        throw InputError(
            fmt::format("{}: camera {} has the unknown model {}, so its number of parameters is "
                        "unknown; convert the COLMAP model to text",
                        name, camera.id, camera.model));
    }
    camera.width_px = reader.read<std::uint64_t>("the width of a camera");
    camera.height_px = reader.read<std::uint64_t>("the height of a camera");
    for (std::size_t i = 0; i < model->num_params; ++i) {
        camera.params.push_back(reader.read<double>("the parameters of a camera"));
    }
    return camera;
}

void read_binary_cameras(const std::filesystem::path& path, SceneBuilder& builder)
{
    const MappedFile file(path);
    ByteReader reader(file.bytes(), path.string());
    const std::uint64_t count = reader.read_count(kCameraBytes, "cameras");
    for (std::uint64_t i = 0; i < count; ++i) {
        builder.add_camera(read_camera(reader, path.string()));
    }
    reader.expect_end("the last camera");
    builder.close_cameras();
}

/// Reads an image without its 2D points.
ImageRecord read_image(ByteReader& reader)
{
    ImageRecord image;
    image.id = reader.read<std::uint32_t>("the id of an image");
    for (double& component : image.rotation_wxyz) {
        component = reader.read<double>("the rotation of an image");
    }
    for (double& component : image.translation) {
        component = reader.read<double>("the translation of an image");
    }
    image.camera_id = reader.read<std::uint32_t>("the camera of an image");
    image.name = reader.read_zero_terminated("the name of an image");
    return image;
}

/// Calls take(reader, image, count) for each image, which must read or skip its `count` 2D points.
template <typename Take>
void read_each_binary_image(const std::filesystem::path& path, const Progress& progress,
                            const Take& take)
{
    const MappedFile file(path);
    ByteReader reader(file.bytes(), path.string());
    const std::uint64_t count = reader.read_count(kImageBytes, "images");
    ReadOnce pages(file);
    for (std::uint64_t i = 0; i < count; ++i) {
        const ImageRecord image = read_image(reader);
        take(reader, image, reader.read_count(kPoint2dBytes, "2D points"));
        pages.read_up_to(reader.offset());
        if (i % kRecordsBetweenReports == 0) progress.report(reader.share_read());
    }
    reader.expect_end("the last image");
}

void read_binary_images(const std::filesystem::path& path, SceneBuilder& builder,
                        const Progress& progress)
{
    const auto take = [&](ByteReader& reader, const ImageRecord& image, std::uint64_t count) {
        builder.add_image(image);
        reader.skip(count, kPoint2dBytes);
    };
    read_each_binary_image(path, progress, take);
    builder.close_images();
}

void read_binary_rays(const std::filesystem::path& path, const TakeRay& told,
                      const Progress& progress)
{
    const auto take = [&](ByteReader& reader, const ImageRecord& image, std::uint64_t count) {
        for (std::uint64_t i = 0; i < count; ++i) {
            const auto x_px = reader.read<double>("the position of a 2D point");
            const auto y_px = reader.read<double>("the position of a 2D point");
            told(image.id, reader.read<std::uint64_t>("the point id of a 2D point"), {x_px, y_px});
        }
    };
    read_each_binary_image(path, progress, take);
}

PointRecord read_point(ByteReader& reader)
{
    PointRecord point;
    point.id = reader.read<std::uint64_t>("the id of a point");
    for (double& coordinate : point.position) {
        coordinate = reader.read<double>("the position of a point");
    }
    point.color = reader.read<Color>("the color of a point");
    point.error_px = reader.read<double>("the error of a point");
    return point;
}

void read_binary_points(const std::filesystem::path& path, SceneBuilder& builder,
                        const Progress& progress)
{
    const MappedFile file(path);
    ByteReader reader(file.bytes(), path.string());
    const std::uint64_t count = reader.read_count(kPointBytes, "points");
    // Bytes that are not points are tracks
    builder.reserve_points(count, (reader.left() - count * kPointBytes) / kTrackElementBytes);
    ReadOnce pages(file);
    std::vector<std::uint32_t> image_ids;
    for (std::uint64_t i = 0; i < count; ++i) {
        const PointRecord point = read_point(reader);
        image_ids.resize(reader.read_count(kTrackElementBytes, "views in a track"));
        for (std::uint32_t& image_id : image_ids) {
            image_id = reader.read<std::uint32_t>("the track of a point");
            reader.read<std::uint32_t>("the track of a point");
        }
        builder.add_point(point, image_ids);
        pages.read_up_to(reader.offset());
        if (i % kRecordsBetweenReports == 0) progress.report(reader.share_read());
    }
    reader.expect_end("the last point");
}

} // namespace

const FormatReader kBinaryReader = {read_binary_cameras, read_binary_images, read_binary_points,
                                    read_binary_rays};

} // namespace vcarve
