#pragma once

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace vcarve {

/// Bytes as one writes them in an option: plain, "1500000", or with K, M or G (of 1024, upper or
/// lower case), "8G", "1.5g". Nothing where it is no such text, is negative, or leaves 63 bits.
std::optional<std::int64_t> parse_byte_size(std::string_view text);

/// The same the other way, rounded to four digits: "8G", "1.465M", "600".
std::string byte_size_text(std::int64_t bytes);

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

/// 24310 -> "24,310"
inline std::string grouped_digits(std::int64_t number)
{
    const std::string digits = std::to_string(number);
    std::string text;
    for (std::size_t i = 0; i < digits.size(); ++i) {
        const bool begins_group = (digits.size() - i) % 3 == 0;
        if (begins_group && i > 0 && digits[i - 1] != '-') text.push_back(',');
        text.push_back(digits[i]);
    }
    return text;
}

/// ASCII letters in lower case.
inline std::string lower_case(std::string text)
{
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return std::tolower(letter); });
    return text;
}

/// The extension of a file in lower case: ".ply" of "a/B.PLY".
inline std::string lower_case_end(const std::filesystem::path& path)
{
    return lower_case(path.extension().string());
}

} // namespace vcarve
