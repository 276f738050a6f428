#pragma once

#include "io/ply/ply_body.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

namespace vcarve {

/// Goes through the data behind a header, element by element, in the order of the header. What
/// fails throws InputError naming the file and the entry.
template <typename Body>
class PlyEntries {
  public:
    /// `path` is for the messages, and must outlive this.
    PlyEntries(Body body, const std::filesystem::path& path) : body_(body), path_(path) {}

    Body& body() { return body_; }
    std::size_t bytes_left() const { return body_.bytes_left(); }
    double number(PlyType type) { return body_.number(type); }

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

    /// The element must have been found to have room.
    void skip_all(const PlyElement& element)
    {
        if (const auto bytes = Body::fixed_bytes(element)) {
            body_.skip_bytes(*bytes * element.count);
            return;
        }
        read_all(element, [&](std::uint64_t) {
            for (const PlyProperty& property : element.properties) {
                skip(property);
            }
        });
    }

    /// Throws BadPlyEntry, as do those below.
    std::size_t list_length(const PlyProperty& property)
    {
        const double length = body_.number(*property.length_type);
        const std::size_t most = body_.bytes_left() / Body::least_bytes(property.type);
        if (!(length >= 0.0 && length <= static_cast<double>(most) &&
              length == std::floor(length))) {
            throw BadPlyEntry{fmt::format("the list \"{}\" has length {}, but only {} bytes follow",
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

  private:
    Body body_;
    const std::filesystem::path& path_;
};

} // namespace vcarve
