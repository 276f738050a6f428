#include "base/text.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace vcarve {

namespace {

constexpr std::string_view kSuffixes = "KMG";

/// Returns 1024 for 'K' and 'k', 1024^2 for 'M' and so on; 0 for other letters.
double factor_of(char suffix)
{
    constexpr char kToUpper = 'A' - 'a';
    const bool is_lower = suffix >= 'a' && suffix <= 'z';
    const auto place = kSuffixes.find(is_lower ? static_cast<char>(suffix + kToUpper) : suffix);
    return place == std::string_view::npos ? 0.0
                                           : std::ldexp(1.0, 10 * (static_cast<int>(place) + 1));
}

} // namespace

std::optional<std::int64_t> parse_byte_size(std::string_view text)
{
    double factor = 1.0;
    if (!text.empty() && factor_of(text.back()) > 0.0) {
        factor = factor_of(text.back());
        text.remove_suffix(1);
    }
    double number = 0.0;
    const auto [end, error] =
        std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    const bool is_number = error == std::errc() && end == text.data() + text.size();
    const double bytes = number * factor;
    if (!is_number || !(bytes >= 0.0 && bytes < 0x1p63)) return std::nullopt;
    return static_cast<std::int64_t>(bytes);
}

std::string byte_size_text(std::int64_t bytes)
{
    auto number = static_cast<double>(bytes);
    std::string suffix;
    for (std::size_t i = 0; i < kSuffixes.size() && number >= 1024.0; ++i) {
        number /= 1024.0;
        suffix = kSuffixes[i];
    }
    return fmt::format("{:.4g}{}", number, suffix);
}

} // namespace vcarve
