#include "picture/caption.h"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace vcarve {

namespace {

constexpr std::size_t kMostLetters = 400;

/// As stb_easy_font has them.
struct TextCorner {
    float x;
    float y;
    float z;
    unsigned char color[4];
};

/// What stb_easy_font knows; beyond it would read past its table.
std::string ascii(std::string text)
{
    // A letter of UTF-8 is one question mark: its later bytes go.
    std::erase_if(text, [](unsigned char byte) { return (byte & 0xc0U) == 0x80U; });
    std::ranges::replace_if(
        text, [](char letter) { return letter < ' ' || letter > '~'; }, '?');
    return text.substr(0, kMostLetters);
}

} // namespace

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
    // A letter has fewer than 20 strokes of four corners each.
    constexpr std::size_t kCorners = 4;
    std::vector<TextCorner> corners(20 * kCorners * shown.size());
    const int strokes = stb_easy_font_print(0.0F, 0.0F, shown.data(), nullptr, corners.data(),
                                            static_cast<int>(corners.size() * sizeof(TextCorner)));
    const auto pixel = [&](const TextCorner& corner) -> Eigen::Array2i {
        return at_px + (static_cast<float>(scale) * Eigen::Array2f(corner.x, corner.y)).cast<int>();
    };
    for (std::size_t i = 0; i < kCorners * static_cast<std::size_t>(strokes); i += kCorners) {
        // Corners run around the stroke, so the first and the third are opposite.
        fill_box(pixel(corners[i]), pixel(corners[i + 2]), color, picture);
    }
}

} // namespace vcarve
