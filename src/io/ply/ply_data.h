#pragma once

#include "io/ply/ply_header.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace vcarve {

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
    template <typename Number>
    Number take();

    std::string_view bytes_;
    PlyEncoding encoding_;
    const std::filesystem::path& path_;
};

} // namespace vcarve
