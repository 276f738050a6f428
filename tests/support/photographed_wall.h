#pragma once

#include "io/images/calibrated_photo.h"
#include "io/images/encode_image.h"
#include "support/temporary_folder.h"
#include "vcarve/tri_mesh.h"

#include <Eigen/Core>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

namespace vcarve {

/// The color of a wall at x and y, from 0 to 255.
inline Eigen::Array3d wall_color(double x, double y)
{
    return {120.0 + 60.0 * std::sin(5.0 * x), 120.0 + 60.0 * std::sin(4.0 * y),
            100.0 + 40.0 * std::cos(3.0 * (x + y))};
}

/// The square from -1 to 1 at z = 0, facing -z: squares x squares cells of two faces.
inline TriMesh wall_mesh(std::uint32_t squares)
{
    TriMesh mesh;
    for (std::uint32_t row = 0; row <= squares; ++row) {
        for (std::uint32_t column = 0; column <= squares; ++column) {
            mesh.positions.emplace_back(2.0 * column / squares - 1.0, 2.0 * row / squares - 1.0,
                                        0.0);
        }
    }
    for (std::uint32_t row = 0; row < squares; ++row) {
        for (std::uint32_t column = 0; column < squares; ++column) {
            const std::uint32_t first = row * (squares + 1) + column;
            const std::uint32_t above = first + squares + 1;
            mesh.faces.push_back({first, above, first + 1});
            mesh.faces.push_back({first + 1, above, above + 1});
        }
    }
    return mesh;
}

/// A camera of 160 x 120 pixels that looks along z; 100 pixels per unit at distance 1.
inline CalibratedPhoto photo_from(const Eigen::Vector3d& center)
{
    CalibratedPhoto photo;
    photo.size = {160, 120};
    photo.focal_px = 100;
    photo.pose.center = center;
    photo.camera = {
        .id = 1, .model = 0, .width_px = 160, .height_px = 120, .params = {100, 80, 60}};
    return photo;
}

/// The photograph of an unbounded wall by such a camera. `paint_over` may change the color of any
/// pixel.
inline Photograph
photograph_of_wall(const CalibratedPhoto& photo, const Eigen::Array3d& exposure = {1.0, 1.0, 1.0},
                   const std::function<void(int, int, Eigen::Array3d&)>& paint_over = {})
{
    Photograph image{photo.size.width_px, photo.size.height_px, {}};
    for (int y = 0; y < image.height_px; ++y) {
        for (int x = 0; x < image.width_px; ++x) {
            const double distance = -photo.pose.center.z();
            Eigen::Array3d color =
                exposure * wall_color(photo.pose.center.x() + distance * (x + 0.5 - 80.0) / 100.0,
                                      photo.pose.center.y() + distance * (y + 0.5 - 60.0) / 100.0);
            if (paint_over) paint_over(x, y, color);
            for (const double channel : color) {
                image.rgb.push_back(
                    static_cast<std::uint8_t>(std::lround(std::clamp(channel, 0.0, 255.0))));
            }
        }
    }
    return image;
}

using IsBlack = std::function<bool(int, int)>; ///< of x and y

/// A black and white mask of any size.
inline Photograph mask_image(int width_px, int height_px, const IsBlack& is_black)
{
    constexpr std::uint8_t kWhite = 255;
    Photograph image{width_px, height_px, {}};
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            image.rgb.insert(image.rgb.end(), 3, is_black(x, y) ? 0 : kWhite);
        }
    }
    return image;
}

inline void write_photograph(const std::filesystem::path& path, const Photograph& image)
{
    const std::vector<std::uint8_t> bytes = encode_png(image);
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size()));
}

/// Writes a PNG with an alpha channel.
inline void write_cutout(const std::filesystem::path& path, const Photograph& image)
{
    std::vector<std::uint8_t> pixels;
    for (std::size_t i = 0; i < image.alpha.size(); ++i) {
        pixels.insert(pixels.end(), {image.rgb[3 * i], image.rgb[3 * i + 1], image.rgb[3 * i + 2],
                                     image.alpha[i]});
    }
    png_image png{};
    png.version = PNG_IMAGE_VERSION;
    png.width = static_cast<png_uint_32>(image.width_px);
    png.height = static_cast<png_uint_32>(image.height_px);
    png.format = PNG_FORMAT_RGBA;
    png_image_write_to_file(&png, path.c_str(), 0, pixels.data(), 0, nullptr);
}

} // namespace vcarve
