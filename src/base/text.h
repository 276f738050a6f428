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

/// Parses the byte size of an option: "1500000", or with a suffix K, M or G in either case (powers
/// of 1024), "8G", "1.5g". Returns nothing for other texts, negative sizes, and 2^63 or more.
std::optional<std::int64_t> parse_byte_size(std::string_view text);

/// Formats a byte size with at most four significant digits: "8G", "1.465M", "600".
std::string byte_size_text(std::int64_t bytes);

/// Replaces control characters, which a terminal would obey, by question marks. This includes
/// U+0080 to U+009F in UTF-8.
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

/// Formats a number with commas: "24,310" for 24310.
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

/// A number and its noun, which is given in the plural: "1 vertex", "24,310 faces".
inline std::string counted(std::int64_t number, std::string_view nouns)
{
    const std::string_view noun =
        nouns == "vertices" ? "vertex" : nouns.substr(0, nouns.size() - 1);
    return grouped_digits(number) + " " + std::string(number == 1 ? noun : nouns);
}

/// Converts ASCII letters to lower case.
inline std::string lower_case(std::string text)
{
    std::ranges::transform(text, text.begin(),
                           [](unsigned char letter) { return std::tolower(letter); });
    return text;
}

/// The file extension in lower case: ".ply" for "a/B.PLY".
inline std::string lower_case_end(const std::filesystem::path& path)
{
    return lower_case(path.extension().string());
}

} // namespace vcarve
