#include "io/images/decoders.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_BMP
#define STBI_ONLY_TGA
#define STBI_NO_STDIO
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif

#include <algorithm>
#include <cstdlib>
#include <memory>

namespace vcarve {

namespace {

/// Feeds stb_image and detects truncated files, because stb_image replaces missing bytes by zeros.
struct Source {
    std::span<const std::uint8_t> rest;
    const char* buffer = nullptr; ///< stb_image's buffer, to which it reads ahead
    bool is_cut_off = false;

    int read(char* to, std::size_t count)
    {
        if (buffer == nullptr) buffer = to; // the first read fills it
        const std::size_t given = std::min(rest.size(), count);
        is_cut_off = is_cut_off || given < (to == buffer ? 1 : count);
        std::copy_n(rest.data(), given, to);
        rest = rest.subspan(given);
        return static_cast<int>(given);
    }
};

constexpr stbi_io_callbacks kCallbacks = {
    [](void* user, char* to, int count) {
        return static_cast<Source*>(user)->read(to, static_cast<std::size_t>(count));
    },
    [](void* user, int count) {
        auto& rest = static_cast<Source*>(user)->rest;
        rest = rest.subspan(std::min(rest.size(), static_cast<std::size_t>(count)));
    },
    nullptr}; // only other formats need end of file

void require(bool is_read, const ImageFile& file, const Source& source)
{
    if (is_read && !source.is_cut_off) return;
    refuse_image(file, file.bytes[0] == 'B' ? "BMP" : "TGA",
                 source.is_cut_off ? "it is truncated"
                                   : "it is damaged, or its compression is not supported");
}

} // namespace

PhotographSize stb_size(const ImageFile& file)
{
    Source source{file.bytes};
    int width_px = 0;
    int height_px = 0; // negative if the first row is at the top
    require(stbi_info_from_callbacks(&kCallbacks, &source, &width_px, &height_px, nullptr) != 0,
            file, source);
    return checked_size(file, static_cast<std::uint32_t>(width_px),
                        static_cast<std::uint64_t>(std::abs(std::int64_t{height_px})));
}

Photograph decode_stb(const ImageFile& file)
{
    Photograph photo = blank_photograph(stb_size(file)); // rejects too many pixels
    Source source{file.bytes};
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> rgba(
        stbi_load_from_callbacks(&kCallbacks, &source, &photo.width_px, &photo.height_px, &channels,
                                 STBI_rgb_alpha),
        stbi_image_free);
    require(rgba != nullptr, file, source);
    split_alpha(rgba.get(), photo);
    return photo;
}

} // namespace vcarve
