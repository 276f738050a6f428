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
    PlyType type = PlyType::float32;    ///< of the value, or of each value of the list
    std::optional<PlyType> length_type; ///< only a list has one
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; ///< as the header says: not yet checked against the file
    std::vector<PlyProperty> properties;
};

/// What the first lines of a PLY file promise.
struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    Eigen::Vector3d offset = Eigen::Vector3d::Zero(); ///< of a comment "offset X Y Z"
    std::size_t size_bytes = 0;                       ///< where the data begins

    const PlyElement* find(std::string_view name) const;
};

/// Reads the header at the beginning of `bytes`; `path` is for the messages. Throws InputError.
PlyHeader parse_ply_header(std::string_view bytes, const std::filesystem::path& path);

/// What is wrong with an entry; PlyData::read_some() adds file and place.
struct BadPlyEntry {
    std::string reason;
};

/// The numbers behind a header, element by element, in the order of the header: as text, separated
/// by white space, or as they lie in the memory of a machine of either byte order. What fails
/// throws InputError naming the file and the entry. A copy goes on from the same place.
class PlyData {
  public:
    /// `path` is for the messages, and must outlive this.
    PlyData(std::string_view file, const PlyHeader& header, const std::filesystem::path& path)
        : bytes_(file.substr(header.size_bytes)), encoding_(header.encoding), path_(path)
    {
    }

    std::size_t bytes_left() const { return bytes_.size(); }
    void skip_bytes(std::size_t count) { bytes_.remove_prefix(count); }

    [[noreturn]] void refuse(std::string_view what) const;
    /// The header's count must fit into what is left of the file, before anything is sized by it.
    void require_room(const PlyElement& element) const;
    /// How many bytes each entry takes; nothing where lists, or text, make them differ.
    std::optional<std::size_t> bytes_of_entry(const PlyElement& element) const;
    /// The element must have been found to have room.
    void skip_all(const PlyElement& element);

    /// Calls read_entry(i) for every entry; adds the place to what it complains about.
    template <typename ReadEntry>
    void read_all(const PlyElement& element, const ReadEntry& read_entry)
    {
        read_some(element, {0, element.count}, read_entry);
    }
    /// From the first to before the second of `range`.
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

    /// Throws BadPlyEntry, as do those below.
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
