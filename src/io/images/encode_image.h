#pragma once

#include "model/photograph.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// A JPEG file of it, at a quality from 1 to 100, always the same bytes. Colours are kept at full
/// resolution, so that those of one chart do not run into its neighbour's. At most 65500 pixels a
/// side.
std::vector<std::uint8_t> encode_jpeg(const Photograph& photo, int quality);

/// A PNG file of it, always the same bytes. Little time is taken to make it small.
std::vector<std::uint8_t> encode_png(const Photograph& photo);

} // namespace vcarve
