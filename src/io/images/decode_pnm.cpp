#include "io/images/decoders.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_PNM
#define STBI_NO_STDIO
#include <stb/stb_image.h>

#include <algorithm>
#include <memory>

namespace vcarve {

namespace {

constexpr const char* kPortableMap = "PPM or PGM";

int num_bytes(const ImageFile& file)
{
    constexpr std::size_t kMost = 0x7fffffff;
    if (file.bytes.size() > kMost) refuse_image(file, kPortableMap, "more than 2 GiB");
    return static_cast<int>(file.bytes.size());
}

} // namespace

PhotographSize pnm_size(const ImageFile& file)
{
    int width_px = 0;
    int height_px = 0;
    int channels = 0;
    const bool is_read = stbi_info_from_memory(file.bytes.data(), num_bytes(file), &width_px,
                                               &height_px, &channels) != 0;
    if (!is_read) refuse_image(file, kPortableMap, stbi_failure_reason());
    return checked_size(file, static_cast<std::uint64_t>(std::max(width_px, 0)),
                        static_cast<std::uint64_t>(std::max(height_px, 0)));
}

Photograph decode_pnm(const ImageFile& file)
{
    constexpr int kChannels = 3;
    Photograph photograph = blank_photograph(pnm_size(file));
    int width_px = 0;
    int height_px = 0;
    int channels = 0;
    const std::unique_ptr<stbi_uc, decltype(&stbi_image_free)> pixels(
        stbi_load_from_memory(file.bytes.data(), num_bytes(file), &width_px, &height_px, &channels,
                              kChannels),
        stbi_image_free);
    if (!pixels) refuse_image(file, kPortableMap, stbi_failure_reason());
    std::copy_n(pixels.get(), photograph.rgb.size(), photograph.rgb.begin());
    return photograph;
}

} // namespace vcarve
