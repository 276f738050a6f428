#pragma once

#include "model/photograph.h"

#include <filesystem>

namespace vcarve {

/// Size of a JPEG, PNG, TIFF, WebP, BMP, TGA, PPM or PGM, by its content; a TGA without a footer
/// needs a name that ends with .tga. Reads the header, decodes no pixel. Throws InputError, one
/// sentence, where it is none, is broken, or has more than 2^29 pixels.
PhotographSize photograph_size(const std::filesystem::path& path);

/// Reads a photograph as COLMAP does: its pixels as they are stored, without EXIF rotation, gray as
/// three equal colors, 16 bits rounded to 8. Alpha is kept if a pixel is transparent. Throws
/// InputError as photograph_size() does, and if pixels are missing. Needs little more memory than
/// the result, but twice the result for progressive JPEGs, BMPs, TGAs and pictures with alpha.
Photograph read_photograph(const std::filesystem::path& path);

} // namespace vcarve
