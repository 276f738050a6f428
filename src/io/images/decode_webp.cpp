#include "io/images/decoders.h"

#include <webp/decode.h>

#include <memory>

namespace vcarve {

PhotographSize webp_size(const ImageFile& file)
{
    int width_px = 0;
    int height_px = 0;
    if (WebPGetInfo(file.bytes.data(), file.bytes.size(), &width_px, &height_px) == 0) {
        refuse_image(file, "WebP", "its header is damaged");
    }
    return checked_size(file, static_cast<std::uint64_t>(width_px),
                        static_cast<std::uint64_t>(height_px));
}

Photograph decode_webp(const ImageFile& file)
{
    Photograph photo = blank_photograph(webp_size(file));
    const std::unique_ptr<std::uint8_t, decltype(&WebPFree)> rgba(
        WebPDecodeRGBA(file.bytes.data(), file.bytes.size(), nullptr, nullptr), WebPFree);
    if (!rgba) refuse_image(file, "WebP", "it is animated, truncated or damaged");
    split_alpha(rgba.get(), photo);
    return photo;
}

} // namespace vcarve
