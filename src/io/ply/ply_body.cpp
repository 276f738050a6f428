#include "io/ply/ply_body.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <cstring>

namespace vcarve {

double PlyTextBody::number(PlyType /*type*/)
{
    constexpr std::string_view kBlanks = " \t\r\n\v\f";
    bytes_.remove_prefix(std::min(bytes_.find_first_not_of(kBlanks), bytes_.size()));
    if (bytes_.empty()) throw BadPlyEntry{"the file ends there"};
    const std::string_view word = bytes_.substr(0, bytes_.find_first_of(kBlanks));
    const std::size_t sign = word.starts_with('+') ? 1 : 0;
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + sign, end, value);
    if (error == std::errc::invalid_argument || stop != end) {
        throw BadPlyEntry{fmt::format("found \"{:.40}\", expected a number", word)};
    }
    bytes_.remove_prefix(word.size());
    return value;
}

std::optional<std::size_t> PlyBinaryBody::fixed_bytes(const PlyElement& element)
{
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.length_type) return std::nullopt;
        bytes += size_of(property.type);
    }
    return bytes;
}

template <typename Number>
Number PlyBinaryBody::take()
{
    if (bytes_.size() < sizeof(Number)) throw BadPlyEntry{"the file ends there"};
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data(), raw.size());
    if (swaps_) std::ranges::reverse(raw);
    bytes_.remove_prefix(raw.size());
    return std::bit_cast<Number>(raw);
}

double PlyBinaryBody::number(PlyType type)
{
    switch (type) {
    case PlyType::int8:
        return take<std::int8_t>();
    case PlyType::uint8:
        return take<std::uint8_t>();
    case PlyType::int16:
        return take<std::int16_t>();
    case PlyType::uint16:
        return take<std::uint16_t>();
    case PlyType::int32:
        return take<std::int32_t>();
    case PlyType::uint32:
        return take<std::uint32_t>();
    case PlyType::float32:
        return take<float>();
    case PlyType::float64:
        break;
    }
    return take<double>();
}

} // namespace vcarve
