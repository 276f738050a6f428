#pragma once

#include "model/photograph.h"

#include <filesystem>

namespace vcarve {

/// The size of a JPEG, PNG, TIFF, WebP, BMP, TGA, PPM or PGM. The content determines the format,
/// but a TGA without footer needs the extension .tga. Reads only the header. Throws InputError with
/// one sentence if the file has another format, is broken, or has more than 2^29 pixels.
PhotographSize photograph_size(const std::filesystem::path& path);

/// Reads a photograph like COLMAP: pixels as stored, without EXIF rotation, gray as three equal
/// channels, 16 bits rounded to 8. Keeps alpha if a pixel is transparent. Throws InputError like
/// photograph_size(), and if pixels are missing. Needs little more memory than the result, but
/// twice as much for progressive JPEGs, BMPs, TGAs and files with alpha.
Photograph read_photograph(const std::filesystem::path& path);

} // namespace vcarve
