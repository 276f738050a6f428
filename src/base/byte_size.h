#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace vcarve {

/// Bytes as one writes them in an option: plain, "1500000", or with K, M or G (of 1024, upper or
/// lower case), "8G", "1.5g". Nothing where it is no such text, is negative, or leaves 63 bits.
std::optional<std::int64_t> parse_byte_size(std::string_view text);

/// The same the other way, rounded to four digits: "8G", "1.465M", "600".
std::string byte_size_text(std::int64_t bytes);

} // namespace vcarve
