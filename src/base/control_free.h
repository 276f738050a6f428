#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vcarve {

/// `text` with question marks for control characters, which a terminal would obey; also for those
/// of UTF-8, U+0080 to U+009F.
inline std::string control_free(std::string_view text)
{
    std::string shown;
    shown.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const auto byte = static_cast<unsigned char>(text[i]);
        const auto next = static_cast<unsigned char>(i + 1 < text.size() ? text[i + 1] : '\0');
        const bool is_wide = byte == 0xC2 && next >= 0x80 && next < 0xA0;
        shown += is_wide || byte < 0x20 || byte == 0x7F ? '?' : text[i];
        if (is_wide) ++i;
    }
    return shown;
}

} // namespace vcarve
