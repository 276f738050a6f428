#include "io/images/read_photograph.h"

#include "base/text.h"
#include "io/files/mapped_file.h"
#include "io/images/decoders.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <utility>

namespace vcarve {

namespace {

using namespace std::string_view_literals;

struct Decoder {
    PhotographSize (*size)(const ImageFile&);
    Photograph (*decode)(const ImageFile&);
};

constexpr Decoder kJpeg{jpeg_size, decode_jpeg};
constexpr Decoder kPng{png_size, decode_png};
constexpr Decoder kPnm{pnm_size, decode_pnm};
constexpr Decoder kStb{stb_size, decode_stb};
constexpr Decoder kTiff{tiff_size, decode_tiff};
constexpr Decoder kWebp{webp_size, decode_webp};

/// The first bytes of each format. TIFF has two byte orders and two offset sizes.
constexpr struct {
    std::string_view begin;
    Decoder decoder;
} kKinds[] = {
    {"\xff\xd8\xff"sv, kJpeg},
    {"\x89PNG\r\n\x1a\n"sv, kPng},
    {"P6"sv, kPnm},
    {"P5"sv, kPnm},
    {"II*\0"sv, kTiff},
    {"MM\0*"sv, kTiff},
    {"II+\0"sv, kTiff},
    {"MM\0+"sv, kTiff},
    {"BM"sv, kStb},
};

/// Unsupported formats, recognized by text in their first 12 bytes.
constexpr std::pair<std::string_view, const char*> kUnread[] = {
    {"GIF8", "a GIF"},     {"JXL ", "a JPEG XL"},  {"jP  ", "a JPEG 2000"}, {"ftypavif", "an AVIF"},
    {"ftyphei", "a HEIC"}, {"ftypmif1", "a HEIC"}, {"P3\n", "a text PPM"},  {"P3 ", "a text PPM"},
};

const Decoder& decoder_of(const std::filesystem::path& path, std::span<const char> bytes)
{
    if (bytes.empty()) {
        throw InputError(fmt::format("{}: the file is empty, but a photograph is expected; copy "
                                     "it again",
                                     path.string()));
    }
    const std::string_view text(bytes.data(), bytes.size());
    for (const auto& kind : kKinds) {
        if (text.starts_with(kind.begin)) return kind.decoder;
    }
    if (text.starts_with("RIFF") && text.substr(0, 12).ends_with("WEBP")) return kWebp;
    // TGA has no signature at the beginning; version 2 has one at the end.
    if (lower_case_end(path) == ".tga" || text.ends_with("TRUEVISION-XFILE.\0"sv)) return kStb;
    const auto* const unread = std::ranges::find_if(kUnread, [&](const auto& kind) {
        return text.substr(0, 12).find(kind.first) != std::string_view::npos;
    });
    const bool is_known = unread != std::ranges::end(kUnread);
    throw InputError(
        fmt::format("{}: found {}, but photographs must be JPEG, PNG, TIFF, WebP, BMP, "
                    "TGA, binary PPM or PGM; convert it to one of them",
                    path.string(), is_known ? unread->second : "an unknown format"));
}

ImageFile image_file(const std::filesystem::path& path, std::span<const char> bytes)
{
    return {path, {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}};
}

} // namespace

void refuse_image(const ImageFile& file, const char* kind, std::string_view reason)
{
    throw InputError(fmt::format("{}: found a {} that cannot be read ({}), but a complete "
                                 "photograph is expected; copy or convert it again",
                                 file.path.string(), kind, reason));
}

PhotographSize checked_size(const ImageFile& file, std::uint64_t width_px, std::uint64_t height_px)
{
    constexpr std::uint64_t kMostPixels = std::uint64_t{1} << 29U;
    const bool fits = width_px > 0 && height_px > 0 && width_px <= kMostPixels / height_px;
    if (!fits) {
        throw InputError(fmt::format("{}: found an image of {} x {} pixels, but 1 to {} are "
                                     "expected; replace it, or make it smaller",
                                     file.path.string(), width_px, height_px, kMostPixels));
    }
    return {static_cast<int>(width_px), static_cast<int>(height_px)};
}

void drop_opaque_alpha(Photograph& photo)
{
    if (std::ranges::count(photo.alpha, 0) == 0) photo.alpha = {};
}

void split_alpha(const std::uint8_t* rgba, Photograph& photo)
{
    for (std::size_t i = 0; i < photo.rgb.size(); i += 3, rgba += 4) {
        std::copy_n(rgba, 3, &photo.rgb[i]);
        photo.alpha.push_back(rgba[3]);
    }
    drop_opaque_alpha(photo);
}

Photograph blank_photograph(const PhotographSize& size)
{
    const std::size_t bytes = std::size_t{3} * size.width_px * size.height_px;
    return {size.width_px, size.height_px, std::vector<std::uint8_t>(bytes)};
}

PhotographSize photograph_size(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return decoder_of(path, file.bytes()).size(image_file(path, file.bytes()));
}

Photograph read_photograph(const std::filesystem::path& path)
{
    const MappedFile file(path);
    return decoder_of(path, file.bytes()).decode(image_file(path, file.bytes()));
}

} // namespace vcarve
