#pragma once

#include "model/photograph.h"

#include <filesystem>

namespace vcarve {

/// How large a JPEG, PNG, TIFF, PPM or PGM is, whatever it is called: its header is read, no pixel
/// decoded. Throws InputError, one sentence, where it is none, is broken, or has more than 2^29
/// pixels.
PhotographSize photograph_size(const std::filesystem::path& path);

/// Reads one as COLMAP does: as its pixels are stored, whatever EXIF says of turning them, without
/// alpha, grey as three equal colours, 16 bits rounded to 8. Throws InputError as photograph_size
/// does, and where pixels are missing. Needs little more memory than the result, but for
/// progressive JPEGs, which libjpeg keeps as coefficients (twice the result).
Photograph read_photograph(const std::filesystem::path& path);

} // namespace vcarve
