#include "io/files/mapped_file.h"
#include "io/ply/ply_header.h"
#include "vcarve/error.h"
#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

namespace vcarve {
namespace {

/// What is wrong with an entry; whoever reads the element adds file and place.
struct BadEntry {
    std::string reason;
};

/// Numbers as text, separated by white space.
class TextBody {
  public:
    explicit TextBody(std::string_view bytes) : bytes_(bytes) {}

    std::size_t bytes_left() const { return bytes_.size(); }
    /// A number takes a digit and a blank at least; the last one of the file may do without the
    /// blank.
    std::size_t room_bytes() const { return bytes_.size() + 1; }
    static std::size_t least_bytes(PlyType /*type*/) { return 2; }

    double number(PlyType /*type*/)
    {
        constexpr std::string_view kBlanks = " \t\r\n\v\f";
        bytes_.remove_prefix(std::min(bytes_.find_first_not_of(kBlanks), bytes_.size()));
        if (bytes_.empty()) throw BadEntry{"the file ends there"};
        const std::string_view word = bytes_.substr(0, bytes_.find_first_of(kBlanks));
        const std::size_t sign = word.starts_with('+') ? 1 : 0;
        double value = 0.0;
        const char* const end = word.data() + word.size();
        const auto [stop, error] = std::from_chars(word.data() + sign, end, value);
        if (error == std::errc::invalid_argument || stop != end) {
            throw BadEntry{fmt::format("found \"{:.40}\", expected a number", word)};
        }
        bytes_.remove_prefix(word.size());
        return value;
    }

  private:
    std::string_view bytes_;
};

/// Numbers as they lie in the memory of a machine of either byte order.
class BinaryBody {
  public:
    BinaryBody(std::string_view bytes, std::endian order)
        : bytes_(bytes), swaps_(order != std::endian::native)
    {
    }

    std::size_t bytes_left() const { return bytes_.size(); }
    std::size_t room_bytes() const { return bytes_.size(); }
    static std::size_t least_bytes(PlyType type) { return size_of(type); }

    double number(PlyType type)
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

  private:
    template <typename Number>
    Number take()
    {
        if (bytes_.size() < sizeof(Number)) throw BadEntry{"the file ends there"};
        std::array<char, sizeof(Number)> raw;
        std::memcpy(raw.data(), bytes_.data(), raw.size());
        if (swaps_) std::ranges::reverse(raw);
        bytes_.remove_prefix(raw.size());
        return std::bit_cast<Number>(raw);
    }

    std::string_view bytes_;
    bool swaps_;
};

/// Where a value of the file goes to.
enum class Slot { x, y, z, nx, ny, nz, red, green, blue, none };

Slot slot_of(const PlyProperty& property)
{
    constexpr std::array<std::string_view, 9> kNames{"x",  "y",   "z",     "nx",  "ny",
                                                     "nz", "red", "green", "blue"};
    constexpr std::string_view kDiffuse = "diffuse_";
    std::string_view name = property.name;
    if (name.starts_with(kDiffuse)) name.remove_prefix(kDiffuse.size());
    const auto* const found = std::ranges::find(kNames, name);
    return property.length_type ? Slot::none : static_cast<Slot>(found - kNames.begin());
}

/// A colour of any number type as one of 0 to 255.
std::uint8_t channel(double value, PlyType type)
{
    if (!is_integer(type)) value *= 255.0;
    if (type == PlyType::uint16) value /= 257.0;
    return static_cast<std::uint8_t>(std::isnan(value) ? 0.0
                                                       : std::round(std::clamp(value, 0.0, 255.0)));
}

/// Reads the data behind a header, element by element.
template <typename Body>
class SurfaceReader {
  public:
    SurfaceReader(const PlyHeader& header, Body body, const std::filesystem::path& path)
        : header_(header), body_(body), path_(path)
    {
    }

    TriMesh read()
    {
        if (header_.find("vertex") == nullptr) refuse("has no element \"vertex\"");
        num_vertices_ = header_.find("vertex")->count;
        if (header_.find("face") == nullptr) {
            refuse("has points but no element \"face\", expected a surface");
        }
        for (const PlyElement& element : header_.elements) {
            require_room(element);
            if (&element == header_.find("vertex")) {
                read_vertices(element);
            } else if (&element == header_.find("face")) {
                read_faces(element);
            } else {
                read_entries(element, [&](std::uint64_t) { skip_entry(element); });
            }
        }
        return std::move(mesh_);
    }

  private:
    [[noreturn]] void refuse(std::string_view what) const
    {
        throw InputError(fmt::format("{}: {}", path_.string(), what));
    }

    /// The header's count must fit into what is left of the file, before anything is sized by it.
    void require_room(const PlyElement& element) const
    {
        std::size_t entry = 0;
        for (const PlyProperty& property : element.properties) {
            entry += Body::least_bytes(property.length_type.value_or(property.type));
        }
        if (entry > 0 && element.count > body_.room_bytes() / entry) {
            refuse(fmt::format(
                "the header promises {} entries \"{}\" of at least {} bytes, but only {} "
                "bytes follow",
                element.count, element.name, entry, body_.bytes_left()));
        }
    }

    /// Calls read_entry(i) for every entry; adds the place to what it complains about.
    template <typename ReadEntry>
    void read_entries(const PlyElement& element, const ReadEntry& read_entry)
    {
        if (element.properties.empty()) return;
        for (std::uint64_t i = 0; i < element.count; ++i) {
            try {
                read_entry(i);
            } catch (const BadEntry& bad) {
                refuse(fmt::format("{} {} of {}: {}", element.name, i, element.count, bad.reason));
            }
        }
    }

    std::size_t list_length(const PlyProperty& property)
    {
        const double length = body_.number(*property.length_type);
        const std::size_t most = body_.bytes_left() / Body::least_bytes(property.type);
        if (!(length >= 0.0 && length <= static_cast<double>(most) &&
              length == std::floor(length))) {
            throw BadEntry{fmt::format("the list \"{}\" has length {}, but only {} bytes follow",
                                       property.name, length, body_.bytes_left())};
        }
        return static_cast<std::size_t>(length);
    }

    void skip(const PlyProperty& property)
    {
        for (std::size_t n = property.length_type ? list_length(property) : 1; n > 0; --n) {
            body_.number(property.type);
        }
    }

    void skip_entry(const PlyElement& element)
    {
        for (const PlyProperty& property : element.properties) {
            skip(property);
        }
    }

    void read_vertices(const PlyElement& element)
    {
        std::vector<Slot> slots;
        std::ranges::transform(element.properties, std::back_inserter(slots), slot_of);
        const auto has_three_from = [&](Slot first) {
            const auto has = [&](int i) {
                return std::ranges::count(slots, static_cast<Slot>(static_cast<int>(first) + i)) >
                       0;
            };
            return has(0) && has(1) && has(2);
        };
        if (!has_three_from(Slot::x)) refuse("the vertices lack one of the properties x, y and z");
        mesh_.positions.resize(element.count);
        if (has_three_from(Slot::nx)) mesh_.normals.resize(element.count);
        if (has_three_from(Slot::red)) mesh_.colors.resize(element.count);
        read_entries(element, [&](std::uint64_t i) { read_vertex(element, slots, i); });
    }

    void read_vertex(const PlyElement& element, const std::vector<Slot>& slots,
                     std::uint64_t vertex)
    {
        std::array<double, 10> values{}; // by slot; the last takes what is not kept
        for (std::size_t p = 0; p < slots.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.length_type) {
                skip(property);
                continue;
            }
            const double value = body_.number(property.type);
            const bool is_color = slots[p] >= Slot::red && slots[p] <= Slot::blue;
            values[static_cast<std::size_t>(slots[p])] =
                is_color ? channel(value, property.type) : value;
        }
        const Eigen::Vector3d position(values[0], values[1], values[2]);
        if (!position.allFinite()) {
            throw BadEntry{fmt::format("its position is ({}, {}, {}), expected finite numbers",
                                       values[0], values[1], values[2])};
        }
        mesh_.positions[vertex] = position;
        if (!mesh_.normals.empty()) {
            mesh_.normals[vertex] = Eigen::Vector3d(values[3], values[4], values[5]).cast<float>();
        }
        if (!mesh_.colors.empty()) {
            std::transform(values.begin() + 6, values.begin() + 9, mesh_.colors[vertex].begin(),
                           [](double value) { return static_cast<std::uint8_t>(value); });
        }
    }

    void read_faces(const PlyElement& element)
    {
        const auto is_corners = [](const PlyProperty& property) {
            const bool named = property.name == "vertex_indices" || property.name == "vertex_index";
            return named && property.length_type && is_integer(property.type);
        };
        const auto corners = std::ranges::find_if(element.properties, is_corners);
        if (corners == element.properties.end()) {
            refuse("the faces have no list \"vertex_indices\" of integers");
        }
        mesh_.faces.reserve(element.count);
        read_entries(element, [&](std::uint64_t) {
            for (auto p = element.properties.begin(); p != element.properties.end(); ++p) {
                p == corners ? read_face(*p) : skip(*p);
            }
        });
    }

    /// A polygon becomes a fan around its first corner.
    void read_face(const PlyProperty& corners)
    {
        const std::size_t length = list_length(corners);
        if (length < 3) {
            throw BadEntry{fmt::format("it has {} corners, expected 3 or more", length)};
        }
        const std::uint32_t first = corner(corners.type);
        std::uint32_t previous = corner(corners.type);
        for (std::size_t i = 2; i < length; ++i) {
            const std::uint32_t next = corner(corners.type);
            mesh_.faces.push_back({first, previous, next});
            previous = next;
        }
    }

    std::uint32_t corner(PlyType type)
    {
        const double index = body_.number(type);
        const bool exists = index >= 0.0 && index < static_cast<double>(num_vertices_);
        if (!exists || index != std::floor(index)) {
            throw BadEntry{
                fmt::format("it uses vertex {}, but there are {} vertices", index, num_vertices_)};
        }
        return static_cast<std::uint32_t>(index);
    }

    const PlyHeader& header_;
    Body body_;
    const std::filesystem::path& path_;
    std::uint64_t num_vertices_ = 0;
    TriMesh mesh_;
};

} // namespace

TriMesh read_ply(const std::filesystem::path& path)
{
    const MappedFile file(path);
    const std::string_view bytes(file.bytes().data(), file.bytes().size());
    const PlyHeader header = parse_ply_header(bytes, path);
    const std::string_view body = bytes.substr(header.size_bytes);
    if (header.encoding == PlyEncoding::ascii) {
        return SurfaceReader(header, TextBody(body), path).read();
    }
    const std::endian order =
        header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little;
    return SurfaceReader(header, BinaryBody(body, order), path).read();
}

} // namespace vcarve
