#pragma once

#include <Eigen/Core>
#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

enum class PlyEncoding { ascii, little_endian, big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

inline bool is_integer(PlyType type)
{
    return type < PlyType::float32;
}

struct PlyProperty {
    std::string name;
    PlyType type = PlyType::float32;    ///< type of the value or the list items
    std::optional<PlyType> length_type; ///< only for lists
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< as declared, not checked against the file
    std::vector<PlyProperty> properties;
};

/// The parsed header of a PLY file.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< from a comment "offset X Y Z"
    std::size_t size_bytes = 0;                       ///< offset of the data

    const PlyElement* find(std::string_view name) const;
};

/// Parses the header at the beginning of `bytes`. `path` is for error messages. Throws InputError.
PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& path);

/// An error in an entry. PlyData::read_some() adds the file and the entry.
struct BadPlyEntry {
    std::string reason;
};

/// Reads the numbers after a header, element by element in the header's order: text separated by
/// white space, or binary numbers in either byte order. Throws InputError with the file and the
/// entry. A copy continues at the same position.
class PlyData {
  public:
    /// `path` is for error messages, and must outlive this object.
    PlyData(std::string_view file, const PlyHeader& header, const std::filesystem::path& path)
        : bytes_(file.substr(header.size_bytes)), encoding_(header.encoding), path_(path)
    {
    }

    std::size_t bytes_left() const { return bytes_.size(); }
    void skip_bytes(std::size_t count) { bytes_.remove_prefix(count); }

    [[noreturn]] void refuse(std::string_view what) const;
    /// Throws InputError if the declared entries cannot fit into the rest of the file. Must be
    /// called before memory is allocated for them.
    void require_room(const PlyElement& element) const;
    /// The size of each entry in bytes, or nothing if sizes vary because of lists or text.
    std::optional<std::size_t> bytes_of_entry(const PlyElement& element) const;
    /// Skips all entries of an element that passed require_room().
    void skip_all(const PlyElement& element);

    /// Calls read_entry(i) for every entry. Adds the entry to its BadPlyEntry errors.
    template <typename ReadEntry>
    void read_all(const PlyElement& element, const ReadEntry& read_entry)
    {
        read_some(element, {0, element.count}, read_entry);
    }
    /// The same for the entries from the first of `range` to before the second.
    template <typename ReadEntry>
    void read_some(const PlyElement& element, std::pair<std::uint64_t, std::uint64_t> range,
                   const ReadEntry& read_entry)
    {
        if (element.properties.empty()) return;
        for (std::uint64_t i = range.first; i < range.second; ++i) {
            try {
                read_entry(i);
            } catch (const BadPlyEntry& bad) {
                refuse(fmt::format("{} {} of {}: {}", element.name, i, element.count, bad.reason));
            }
        }
    }

    /// Reads a number. This function and the next two throw BadPlyEntry.
    double number(PlyType type);
    std::size_t list_length(const PlyProperty& property);
    void skip(const PlyProperty& property);

  private:
    bool is_text() const { return encoding_ == PlyEncoding::ascii; }
    std::size_t least_bytes(PlyType type) const;
    double number_of_text();

    std::string_view bytes_;
    PlyEncoding encoding_;
    const std::filesystem::path& path_;
};

} // namespace vcarve
