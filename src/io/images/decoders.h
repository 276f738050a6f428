#pragma once

#include "model/photograph.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>

namespace vcarve {

/// The input of a decoder: a file, and its path for error messages.
struct ImageFile {
    const std::filesystem::path& path;
    std::span<const std::uint8_t> bytes;
};

PhotographSize jpeg_size(const ImageFile& file);
PhotographSize png_size(const ImageFile& file);
PhotographSize pnm_size(const ImageFile& file);
PhotographSize stb_size(const ImageFile& file); ///< BMP and TGA
PhotographSize tiff_size(const ImageFile& file);
PhotographSize webp_size(const ImageFile& file);

Photograph decode_jpeg(const ImageFile& file);
Photograph decode_png(const ImageFile& file);
Photograph decode_pnm(const ImageFile& file); ///< binary PPM and PGM
Photograph decode_stb(const ImageFile& file); ///< BMP without RLE, and TGA
Photograph decode_tiff(const ImageFile& file);
Photograph decode_webp(const ImageFile& file);

/// Throws InputError with the reason that the library reports.
[[noreturn]] void refuse_image(const ImageFile& file, const char* kind, std::string_view reason);

/// Converts the size that a header declares. Throws InputError if it is zero or too large.
PhotographSize checked_size(const ImageFile& file, std::uint64_t width_px, std::uint64_t height_px);

/// Empties the alpha channel if no pixel is transparent.
void drop_opaque_alpha(Photograph& photo);

/// Copies RGBA pixels to the colors and the alpha channel of a photograph.
void split_alpha(const std::uint8_t* rgba, Photograph& photo);

/// Returns a black photograph of this size.
Photograph blank_photograph(const PhotographSize& size);

} // namespace vcarve
