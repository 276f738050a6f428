// Layout: https://colmap.github.io/format.html. One line per camera and point, and two lines per
// image. The second line has the 2D points and may be empty.

#include "io/colmap/colmap_formats.h"
#include "io/colmap/text_reader.h"
#include "io/files/mapped_file.h"
#include "model/lens.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve {

namespace {

Camera read_camera(TextReader& reader)
{
    Camera camera;
    camera.id = reader.read_uint32("the id of a camera");
    const std::string_view model_name = reader.read_word("the model of the camera");
    const LensModel* model = lens_model(model_name);
    camera.model = model != nullptr ? model->number : -1;
    camera.width_px = reader.read_uint64("the width of the camera");
    camera.height_px = reader.read_uint64("the height of the camera");
    while (!reader.at_line_end()) {
        camera.params.push_back(reader.read_double("a parameter of the camera"));
    }
    if (model != nullptr && camera.params.size() != model->num_params) {
        reader.fail(fmt::format("found {} parameters, but a {} camera has {}", camera.params.size(),
                                model_name, model->num_params));
    }
    return camera;
}

void read_text_cameras(const std::filesystem::path& path, SceneBuilder& builder)
{
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    while (reader.next_record()) {
        builder.add_camera(read_camera(reader));
    }
    builder.close_cameras();
}

/// Throws if a line cannot be 2D points, for example if the second line of an image is missing. The
/// last word must be a point id.
void check_points2d(TextReader& reader)
{
    const std::string_view line = reader.rest();
    if (line.empty()) return;
    const std::string_view word = line.substr(line.find_last_of(" \t") + 1);
    const std::string_view digits = word.substr(word.starts_with('-') ? 1 : 0);
    const bool is_id =
        std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
    if (!is_id || digits.empty()) {
        reader.fail(
            fmt::format("found '{}' at the end of the line, expected the 2D points of the image "
                        "on the previous line (x, y and point id each), or an empty line",
                        printable(word)));
    }
}

ImageRecord read_image(TextReader& reader)
{
    ImageRecord image;
    image.id = reader.read_uint32("the id of an image");
    for (double& component : image.rotation_wxyz) {
        component = reader.read_double("the rotation of the image");
    }
    for (double& component : image.translation) {
        component = reader.read_double("the translation of the image");
    }
    image.camera_id = reader.read_uint32("the camera of the image");
    // A name may contain blanks. A line without a name lacks a field.
    if (reader.at_line_end()) reader.read_word("the name of the image");
    image.name = reader.rest();
    if (reader.next_line()) check_points2d(reader);
    return image;
}

/// Calls take(reader, image) for each image. It may read the 2D points, or ignore them.
template <typename Take>
void read_each_text_image(const std::filesystem::path& path, const Progress& progress,
                          const Take& take)
{
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    ReadOnce pages(file);
    for (std::uint64_t i = 0; reader.next_record(); ++i) {
        const ImageRecord image = read_image(reader);
        take(reader, image);
        pages.read_up_to(reader.offset());
        if (i % kRecordsBetweenReports == 0) progress.report(reader.share_read());
    }
}

void read_text_images(const std::filesystem::path& path, SceneBuilder& builder,
                      const Progress& progress)
{
    read_each_text_image(path, progress, [&](TextReader& /*points2d*/, const ImageRecord& image) {
        builder.add_image(image);
    });
    builder.close_images();
}

void read_text_rays(const std::filesystem::path& path, const TakeRay& told,
                    const Progress& progress)
{
    read_each_text_image(path, progress, [&](TextReader& reader, const ImageRecord& image) {
        while (!reader.at_line_end()) {
            const double x_px = reader.read_double("the position of a 2D point");
            const double y_px = reader.read_double("the position of a 2D point");
            told(image.id, reader.read_uint64_or_none("the point id of a 2D point"), {x_px, y_px});
        }
    });
}

PointRecord read_point(TextReader& reader)
{
    PointRecord point;
    point.id = reader.read_uint64("the id of a point");
    for (double& coordinate : point.position) {
        coordinate = reader.read_double("the position of the point");
    }
    for (std::uint8_t& channel : point.color) {
        channel = reader.read_uint8("the color of the point");
    }
    point.error_px = reader.read_double("the error of the point");
    return point;
}

void read_text_points(const std::filesystem::path& path, SceneBuilder& builder,
                      const Progress& progress)
{
    const MappedFile file(path);
    TextReader reader(file.bytes(), path.string());
    ReadOnce pages(file);
    std::vector<std::uint32_t> image_ids;
    for (std::uint64_t i = 0; reader.next_record(); ++i) {
        const PointRecord point = read_point(reader);
        image_ids.clear();
        while (!reader.at_line_end()) {
            image_ids.push_back(reader.read_uint32_or_none("the id of an image in the track"));
            reader.read_uint32_or_none("the index of a 2D point in the track");
        }
        builder.add_point(point, image_ids);
        pages.read_up_to(reader.offset());
        if (i % kRecordsBetweenReports == 0) progress.report(reader.share_read());
    }
}

} // namespace

const FormatReader kTextReader = {read_text_cameras, read_text_images, read_text_points,
                                  read_text_rays};

} // namespace vcarve
