#include "render/picture.h"

#include "vcarve/error.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cstdint>

namespace vcarve::render {

Picture shrunk(const Picture& picture, int factor)
{
    Picture result{picture.width_px / factor, picture.height_px / factor, {}};
    result.pixels.assign(static_cast<std::size_t>(result.width_px) * result.height_px,
                         Eigen::Array3f::Zero());
    const float weight = 1.0F / static_cast<float>(factor * factor);
    for (int y = 0; y < result.height_px * factor; ++y) {
        for (int x = 0; x < result.width_px * factor; ++x) {
            const std::size_t to =
                static_cast<std::size_t>(y / factor) * result.width_px + x / factor;
            const std::size_t from = static_cast<std::size_t>(y) * picture.width_px + x;
            result.pixels[to] += weight * picture.pixels[from];
        }
    }
    return result;
}

void write_png(const std::filesystem::path& path, const Picture& picture)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * picture.pixels.size());
    for (const Eigen::Array3f& pixel : picture.pixels) {
        for (int k = 0; k < 3; ++k) {
            bytes.push_back(static_cast<std::uint8_t>(std::clamp(pixel[k] + 0.5F, 0.0F, 255.0F)));
        }
    }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(picture.width_px);
    image.height = static_cast<png_uint_32>(picture.height_px);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_file(&image, path.c_str(), 0, bytes.data(), 0, nullptr) == 0) {
        throw UsageError(
            fmt::format("{}: cannot write the picture: {}", path.string(), image.message));
    }
}

} // namespace vcarve::render
