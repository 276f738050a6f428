#include "picture/picture.h"

#include "io/files/output_file.h"
#include "io/images/encode_image.h"

#include <algorithm>
#include <cstdint>

namespace vcarve {

namespace {

std::vector<std::uint8_t> bytes_of(const Picture& picture)
{
    std::vector<std::uint8_t> bytes;
    bytes.reserve(3 * picture.pixels.size());
    for (const Eigen::Array3f& pixel : picture.pixels) {
        for (int k = 0; k < 3; ++k) {
            bytes.push_back(static_cast<std::uint8_t>(std::clamp(pixel[k] + 0.5F, 0.0F, 255.0F)));
        }
    }
    return bytes;
}

} // namespace

Picture even_picture(int width_px, int height_px, const Eigen::Array3f& color)
{
    const std::size_t count = static_cast<std::size_t>(width_px) * height_px;
    return {width_px, height_px, std::vector<Eigen::Array3f>(count, color)};
}

void paste(const Picture& part, int left_px, int top_px, Picture& whole)
{
    for (int y = 0; y < part.height_px; ++y) {
        const auto from = part.pixels.begin() + static_cast<std::ptrdiff_t>(y) * part.width_px;
        const auto to = static_cast<std::ptrdiff_t>(top_px + y) * whole.width_px + left_px;
        std::copy(from, from + part.width_px, whole.pixels.begin() + to);
    }
}

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
    const std::vector<std::uint8_t> file =
        encode_png({picture.width_px, picture.height_px, bytes_of(picture)});
    OutputFile out(path);
    out.stream().write(reinterpret_cast<const char*>(file.data()),
                       static_cast<std::streamsize>(file.size()));
    out.commit();
}

} // namespace vcarve
