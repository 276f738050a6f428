#pragma once

#include "model/photograph.h"

#include <cstdint>
#include <vector>

namespace vcarve {

/// Encodes a JPEG file with a quality from 1 to 100. The bytes depend only on the arguments. Chroma
/// is not subsampled, so the colors of a chart do not bleed into its neighbor. Throws
/// std::runtime_error if a side is longer than 65500 pixels.
std::vector<std::uint8_t> encode_jpeg(const Photograph& photo, int quality);

/// Encodes a PNG file. The bytes depend only on the photograph. Prefers speed to size.
std::vector<std::uint8_t> encode_png(const Photograph& photo);

} // namespace vcarve
