#pragma once

#include <png.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <set>
#include <vector>

namespace vcarve {

using Rgb = std::array<std::uint8_t, 3>;

/// The decoded pixels of a PNG; size 0 if the file is not a PNG.
struct ReadPng {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> bytes; ///< three per pixel

    Rgb at(int x, int y) const
    {
        const std::size_t first = 3 * (static_cast<std::size_t>(y) * width + x);
        return {bytes[first], bytes[first + 1], bytes[first + 2]};
    }

    /// The colors in a rectangle; `right` and `bottom` are excluded.
    std::set<Rgb> colors(int left, int top, int right, int bottom) const
    {
        std::set<Rgb> found;
        for (int y = top; y < bottom; ++y) {
            for (int x = left; x < right; ++x) {
                found.insert(at(x, y));
            }
        }
        return found;
    }
};

inline ReadPng read_png(const std::filesystem::path& path)
{
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0) return {};
    image.format = PNG_FORMAT_RGB;
    ReadPng result{static_cast<int>(image.width), static_cast<int>(image.height), {}};
    result.bytes.resize(PNG_IMAGE_SIZE(image));
    png_image_finish_read(&image, nullptr, result.bytes.data(), 0, nullptr);
    return result;
}

} // namespace vcarve
