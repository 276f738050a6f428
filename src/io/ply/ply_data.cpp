#include "io/ply/ply_data.h"

#include "io/files/block_writer.h"
#include "vcarve/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>

namespace vcarve {

namespace {

/// Reads a number in the byte order of this machine, or in the reverse order.
template <typename Number>
double read_number(const char* bytes, bool is_reversed)
{
    std::array<char, sizeof(Number)> raw;
    std::memcpy(raw.data(), bytes, raw.size());
    if (is_reversed) std::ranges::reverse(raw);
    return static_cast<double>(std::bit_cast<Number>(raw));
}

struct TypeFacts {
    std::string_view name;
    std::string_view sized_name;
    std::size_t bytes;
    double (*read)(const char*, bool);
};

/// Parallel to the values of PlyType.
constexpr std::array<TypeFacts, 8> kTypes{{
    {"char", "int8", 1, read_number<std::int8_t>},
    {"uchar", "uint8", 1, read_number<std::uint8_t>},
    {"short", "int16", 2, read_number<std::int16_t>},
    {"ushort", "uint16", 2, read_number<std::uint16_t>},
    {"int", "int32", 4, read_number<std::int32_t>},
    {"uint", "uint32", 4, read_number<std::uint32_t>},
    {"float", "float32", 4, read_number<float>},
    {"double", "float64", 8, read_number<double>},
}};

const TypeFacts& facts_of(PlyType type)
{
    return kTypes[static_cast<std::size_t>(type)];
}

/// Splits a header into lines of words, and counts lines for error messages.
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
    const auto* const found = std::ranges::find_if(kTypes, [&](const TypeFacts& facts) {
        return name == facts.name || name == facts.sized_name;
    });
    if (found == kTypes.end()) lines.refuse(words, "a number type of PLY");
    return static_cast<PlyType>(found - kTypes.begin());
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

/// Parses "comment offset X Y Z"; ignores other comments.
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

/// Parses one line. Returns false if it is the last one.
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

const PlyElement* PlyHeader::find(std::string_view name) const
{
    const auto found = std::ranges::find(elements, name, &PlyElement::name);
    return found == elements.end() ? nullptr : &*found;
}

PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& path)
{
    if (!bytes.starts_with("ply\n") && !bytes.starts_with("ply\r\n")) {
        throw InputError(fmt::format("{}: the first line is not \"ply\", so this is no PLY file",
                                     path.string()));
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

/// A number in text needs at least a digit and a space.
std::size_t PlyData::least_bytes(PlyType type) const
{
    return is_text() ? 2 : facts_of(type).bytes;
}

void PlyData::require_room(const PlyElement& element) const
{
    std::size_t entry = 0;
    for (const PlyProperty& property : element.properties) {
        entry += least_bytes(property.length_type.value_or(property.type));
    }
    const std::size_t room = bytes_left() + (is_text() ? 1 : 0); // the last one may lack its space
    if (entry > 0 && element.count > room / entry) {
        refuse(fmt::format("the header declares {} entries \"{}\" of at least {} bytes, but only "
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
        bytes += facts_of(property.type).bytes;
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
    constexpr std::string_view kSpaces = " \t\r\n\v\f";
    bytes_.remove_prefix(std::min(bytes_.find_first_not_of(kSpaces), bytes_.size()));
    if (bytes_.empty()) throw BadPlyEntry{"the file ends there"};
    const std::string_view word = bytes_.substr(0, bytes_.find_first_of(kSpaces));
    const std::size_t sign = word.starts_with('+') ? 1 : 0;
    double value = 0.0;
    const char* const end = word.data() + word.size();
    const auto [stop, error] = std::from_chars(word.data() + sign, end, value);
    if (error != std::errc() || stop != end) {
        throw BadPlyEntry{fmt::format("found \"{:.40}\", expected a number", word)};
    }
    bytes_.remove_prefix(word.size());
    return value;
}

double PlyData::number(PlyType type)
{
    if (is_text()) return number_of_text();
    const TypeFacts& facts = facts_of(type);
    if (bytes_.size() < facts.bytes) throw BadPlyEntry{"the file ends there"};
    const bool is_big = encoding_ == PlyEncoding::big_endian;
    const double value =
        facts.read(bytes_.data(), is_big != (std::endian::native == std::endian::big));
    bytes_.remove_prefix(facts.bytes);
    return value;
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
