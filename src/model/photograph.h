#pragma once

#include <cstdint>
#include <vector>

namespace vcarve {

/// How many pixels an image has.
struct PhotographSize {
    int width_px = 0;
    int height_px = 0;
};

/// A photograph, or another image: rows from the top, three bytes a pixel, red first.
struct Photograph {
    int width_px = 0;
    int height_px = 0;
    std::vector<std::uint8_t> rgb;
};

} // namespace vcarve
