#include "picture/picture.h"

#include "io/files/output_file.h"
#include "io/images/encode_image.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

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

constexpr std::size_t kMostLetters = 400;

/// The vertex layout of stb_easy_font.
struct TextCorner {
    float x;
    float y;
    float z;
    unsigned char color[4];
};

/// Replaces other characters than ASCII, for which stb_easy_font would read beyond its table.
std::string ascii(std::string text)
{
    // Dropping continuation bytes leaves one question mark per UTF-8 character.
    std::erase_if(text, [](unsigned char byte) { return (byte & 0xc0U) == 0x80U; });
    std::ranges::replace_if(
        text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return text.substr(0, kMostLetters);
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

int text_width(const std::string& text)
{
    std::string shown = ascii(text);
    return stb_easy_font_width(shown.data());
}

void fill_box(const Eigen::Array2i& from_px, const Eigen::Array2i& to_px,
              const Eigen::Array3f& color, Picture& picture)
{
    const Eigen::Array2i size(picture.width_px, picture.height_px);
    const Eigen::Array2i low = from_px.max(0);
    const Eigen::Array2i high = to_px.min(size);
    for (int y = low.y(); y < high.y(); ++y) {
        for (int x = low.x(); x < high.x(); ++x) {
            picture.pixels[static_cast<std::size_t>(y) * picture.width_px + x] = color;
        }
    }
}

void draw_text(const std::string& text, const Eigen::Array2i& at_px, int scale,
               const Eigen::Array3f& color, Picture& picture)
{
    std::string shown = ascii(text);
    // A letter has fewer than 20 strokes, of four corners each.
    constexpr std::size_t kCorners = 4;
    std::vector<TextCorner> corners(20 * kCorners * shown.size());
    const int strokes = stb_easy_font_print(0.0F, 0.0F, shown.data(), nullptr, corners.data(),
                                            static_cast<int>(corners.size() * sizeof(TextCorner)));
    const auto pixel = [&](const TextCorner& corner) -> Eigen::Array2i {
        return at_px + (static_cast<float>(scale) * Eigen::Array2f(corner.x, corner.y)).cast<int>();
    };
    for (std::size_t i = 0; i < kCorners * static_cast<std::size_t>(strokes); i += kCorners) {
        // Corners are in cyclic order, so the first and the third are opposite.
        fill_box(pixel(corners[i]), pixel(corners[i + 2]), color, picture);
    }
}

} // namespace vcarve
