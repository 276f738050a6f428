#pragma once

#include "model/photograph.h"

#include <filesystem>

namespace vcarve {

/// How large a JPEG, PNG, TIFF, PPM or PGM is, whatever it is called: its header is read, no pixel
/// decoded. Throws InputError, one sentence, where it is none, is broken, or has more than 2^29
/// pixels.
PhotographSize photograph_size(const std::filesystem::path& path);

/// Reads a photograph as COLMAP does: its pixels as they are stored, without EXIF rotation, gray as
/// three equal colors, 16 bits rounded to 8. Alpha is kept if a pixel is transparent. Throws
/// InputError as photograph_size() does, and if pixels are missing. Needs little more memory than
/// the result, but twice the result for progressive JPEGs and PNGs with alpha.
Photograph read_photograph(const std::filesystem::path& path);

} // namespace vcarve
