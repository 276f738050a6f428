#pragma once

#include "io/images/decoders.h"
#include "support/temporary_folder.h"

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

namespace vcarve {

using Bytes = std::vector<std::uint8_t>;

inline std::string_view text_of(const Bytes& bytes)
{
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// The path of a file, for messages.
inline const std::filesystem::path kImagePath = "a folder/photo";

/// Colors that change slowly, so that JPEG preserves them well.
inline Photograph gradient(int width_px, int height_px)
{
    Photograph photo{width_px, height_px, {}};
    for (int y = 0; y < height_px; ++y) {
        for (int x = 0; x < width_px; ++x) {
            for (const int value : {40 + 2 * x, 200 - 3 * y, 90 + x + y}) {
                photo.rgb.push_back(static_cast<std::uint8_t>(value));
            }
        }
    }
    return photo;
}

/// The color of a pixel.
inline Bytes pixel(const Photograph& photo, int x, int y)
{
    const auto at = photo.rgb.begin() + 3 * (static_cast<std::ptrdiff_t>(y) * photo.width_px + x);
    return {at, at + 3};
}

} // namespace vcarve
