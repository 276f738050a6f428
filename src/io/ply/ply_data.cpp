#include "io/ply/ply_data.h"

#include "vcarve/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

namespace vcarve {

void PlyData::refuse(std::string_view what) const
{
    throw InputError(fmt::format("{}: {}", path_.string(), what));
}

/// As text a number takes a digit and a blank at least.
std::size_t PlyData::least_bytes(PlyType type) const
{
    return is_text() ? 2 : size_of(type);
}

void PlyData::require_room(const PlyElement& element) const
{
    std::size_t entry = 0;
    for (const PlyProperty& property : element.properties) {
        entry += least_bytes(property.length_type.value_or(property.type));
    }
    const std::size_t room = bytes_left() + (is_text() ? 1 : 0); // the last may lack its blank
    if (entry > 0 && element.count > room / entry) {
        refuse(fmt::format("the header promises {} entries \"{}\" of at least {} bytes, but only "
                           "{} bytes follow",
                           element.count, element.name, entry, bytes_left()));
    }
}

std::optional<std::size_t> PlyData::bytes_of_entry(const PlyElement& element) const
{
    if (is_text()) return std::nullopt;
    std::size_t bytes = 0;
    for (const PlyProperty& property : element.properties) {
        if (property.length_type) return std::nullopt;
        bytes += size_of(property.type);
    }
    return bytes;
}

void PlyData::skip_all(const PlyElement& element)
{
    if (const auto bytes = bytes_of_entry(element)) return skip_bytes(*bytes * element.count);
    read_all(element, [&](std::uint64_t) {
        for (const PlyProperty& property : element.properties) {
            skip(property);
        }
    });
}

double PlyData::number_of_text()
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

template <typename Number>
Number PlyData::take()
{
    if (bytes_.size() < sizeof(Number)) throw BadPlyEntry{"the file ends there"};
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes_.data(), raw.size());
    const bool is_big = encoding_ == PlyEncoding::big_endian;
    if (is_big != (std::endian::native == std::endian::big)) std::ranges::reverse(raw);
    bytes_.remove_prefix(raw.size());
    return std::bit_cast<Number>(raw);
}

double PlyData::number(PlyType type)
{
    if (is_text()) return number_of_text();
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

std::size_t PlyData::list_length(const PlyProperty& property)
{
    const double length = number(*property.length_type);
    const std::size_t most = bytes_left() / least_bytes(property.type);
    if (!(length >= 0.0 && length <= static_cast<double>(most) && length == std::floor(length))) {
        throw BadPlyEntry{fmt::format("the list \"{}\" has length {}, but only {} bytes follow",
                                      property.name, length, bytes_left())};
    }
    return static_cast<std::size_t>(length);
}

void PlyData::skip(const PlyProperty& property)
{
    for (std::size_t n = property.length_type ? list_length(property) : 1; n > 0; --n) {
        number(property.type);
    }
}

} // namespace vcarve
