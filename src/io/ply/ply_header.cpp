#include "io/ply/ply_header.h"

#include "io/files/block_writer.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>
#include <utility>

namespace vcarve {
namespace {

constexpr std::array<std::pair<std::string_view, PlyType>, 16> kTypeNames{{
    {"char", PlyType::int8},
    {"int8", PlyType::int8},
    {"uchar", PlyType::uint8},
    {"uint8", PlyType::uint8},
    {"short", PlyType::int16},
    {"int16", PlyType::int16},
    {"ushort", PlyType::uint16},
    {"uint16", PlyType::uint16},
    {"int", PlyType::int32},
    {"int32", PlyType::int32},
    {"uint", PlyType::uint32},
    {"uint32", PlyType::uint32},
    {"float", PlyType::float32},
    {"float32", PlyType::float32},
    {"double", PlyType::float64},
    {"float64", PlyType::float64},
}};

/// The lines of a header one by one, each as its words, and where we are for the messages.
class HeaderLines {
  public:
    HeaderLines(std::string_view bytes, const std::filesystem::path& path)
        : bytes_(bytes), path_(path)
    {
    }

    std::vector<std::string> next()
    {
        const std::size_t end = bytes_.find('\n', position_);
        if (end == std::string_view::npos) {
            throw InputError(
                fmt::format("{}: the PLY header has no line end_header", path_.string()));
        }
        ++line_;
        std::istringstream words(std::string(bytes_.substr(position_, end - position_)));
        position_ = end + 1;
        return {std::istream_iterator<std::string>(words), {}};
    }

    [[noreturn]] void refuse(const std::vector<std::string>& words, std::string_view expected) const
    {
        throw InputError(fmt::format("{}: line {} of the PLY header is \"{:.80}\", expected {}",
                                     path_.string(), line_, fmt::to_string(fmt::join(words, " ")),
                                     expected));
    }

    std::size_t position() const { return position_; }

  private:
    std::string_view bytes_;
    const std::filesystem::path& path_;
    std::size_t position_ = 0;
    int line_ = 0;
};

PlyEncoding parse_encoding(const std::vector<std::string>& words, const HeaderLines& lines)
{
    if (words.size() == 3 && words[0] == "format" && words[2] == "1.0") {
        if (words[1] == "ascii") return PlyEncoding::ascii;
        if (words[1] == "binary_little_endian") return PlyEncoding::little_endian;
        if (words[1] == "binary_big_endian") return PlyEncoding::big_endian;
    }
    lines.refuse(words, "\"format ascii 1.0\" or one of the two binary formats");
}

PlyElement parse_element(const std::vector<std::string>& words, const HeaderLines& lines)
{
    PlyElement element;
    if (words.size() == 3) {
        element.name = words[1];
        const char* const end = words[2].data() + words[2].size();
        const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
        if (error == std::errc() && stop == end) return element;
    }
    lines.refuse(words, "\"element NAME COUNT\"");
}

PlyType parse_type(const std::string& name, const std::vector<std::string>& words,
                   const HeaderLines& lines)
{
    const auto* const found = std::ranges::find(kTypeNames, std::string_view(name),
                                                [](const auto& entry) { return entry.first; });
    if (found == kTypeNames.end()) lines.refuse(words, "a number type of PLY");
    return found->second;
}

PlyProperty parse_property(const std::vector<std::string>& words, const HeaderLines& lines)
{
    PlyProperty property;
    property.name = words.back();
    if (words.size() == 5 && words[1] == "list") {
        property.length_type = parse_type(words[2], words, lines);
        property.type = parse_type(words[3], words, lines);
        if (!is_integer(*property.length_type)) lines.refuse(words, "a length of integer type");
        return property;
    }
    if (words.size() != 3) lines.refuse(words, "\"property TYPE NAME\"");
    property.type = parse_type(words[1], words, lines);
    return property;
}

/// What "comment offset X Y Z" says; any other comment says nothing.
void take_comment(const std::vector<std::string>& words, PlyHeader& header)
{
    if (words.size() != 5 || words[1] != kOffsetWord) return;
    Eigen::Vector3d offset;
    for (int axis = 0; axis < 3; ++axis) {
        const std::string& word = words[static_cast<std::size_t>(axis) + 2];
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data(), end, offset[axis]);
        if (error != std::errc() || stop != end) return;
    }
    if (offset.allFinite()) header.offset = offset;
}

/// Takes one line; false at the last.
bool take_line(const std::vector<std::string>& words, const HeaderLines& lines, PlyHeader& header)
{
    if (words.empty() || words[0] == "obj_info") return true;
    if (words[0] == "comment") {
        take_comment(words, header);
        return true;
    }
    if (words[0] == "end_header") return false;
    if (words[0] == "element") {
        header.elements.push_back(parse_element(words, lines));
    } else if (words[0] == "property" && !header.elements.empty()) {
        header.elements.back().properties.push_back(parse_property(words, lines));
    } else {
        lines.refuse(words, "element, property, comment or end_header");
    }
    return true;
}

} // namespace

std::size_t size_of(PlyType type)
{
    constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<std::size_t>(type)];
}

const PlyElement* PlyHeader::find(std::string_view name) const
{
    const auto found = std::ranges::find(elements, name, &PlyElement::name);
    return found == elements.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& path)
{
    if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r\n")) {
        throw InputError(fmt::format(
            "{}: does not begin with the line \"ply\", so it is no PLY file", path.string()));
    }
    HeaderLines lines(bytes, path);
    lines.next();
    PlyHeader header;
    header.encoding = parse_encoding(lines.next(), lines);
    while (take_line(lines.next(), lines, header)) {
    }
    header.size_bytes = lines.position();
    return header;
}

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
