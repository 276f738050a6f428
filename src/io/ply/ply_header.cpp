#include "io/ply/ply_header.h"

#include "io/files/block_writer.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
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

} // namespace vcarve
