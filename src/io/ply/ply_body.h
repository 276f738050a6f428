#pragma once

#include "io/ply/ply_header.h"

#include <bit>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace vcarve {

/// What is wrong with an entry; whoever reads the element adds file and place.
struct BadPlyEntry {
    std::string reason;
};

/// Numbers as text, separated by white space.
class PlyTextBody {
  public:
    explicit PlyTextBody(std::string_view bytes) : bytes_(bytes) {}

    std::size_t bytes_left() const { return bytes_.size(); }
    /// A number takes a digit and a blank at least; the last one of the file may do without the
    /// blank.
    std::size_t room_bytes() const { return bytes_.size() + 1; }
    static std::size_t least_bytes(PlyType /*type*/) { return 2; }
    /// Numbers of text have no size of their own.
    static std::optional<std::size_t> fixed_bytes(const PlyElement& /*element*/) { return {}; }
    void skip_bytes(std::size_t count) { bytes_.remove_prefix(count); }

    /// Throws BadPlyEntry.
    double number(PlyType type);

  private:
    std::string_view bytes_;
};

/// Numbers as they lie in the memory of a machine of either byte order.
class PlyBinaryBody {
  public:
    PlyBinaryBody(std::string_view bytes, std::endian order)
        : bytes_(bytes), swaps_(order != std::endian::native)
    {
    }

    std::size_t bytes_left() const { return bytes_.size(); }
    std::size_t room_bytes() const { return bytes_.size(); }
    static std::size_t least_bytes(PlyType type) { return size_of(type); }
    /// How many bytes each entry takes; nothing where lists make them differ.
    static std::optional<std::size_t> fixed_bytes(const PlyElement& element);
    void skip_bytes(std::size_t count) { bytes_.remove_prefix(count); }

    /// Throws BadPlyEntry.
    double number(PlyType type);

  private:
    template <typename Number>
    Number take();

    std::string_view bytes_;
    bool swaps_;
};

/// Calls visit(body) with the data behind a header, in its encoding, and returns what that returns.
template <typename Visit>
auto visit_ply_body(std::string_view bytes, const PlyHeader& header, const Visit& visit)
{
    const std::string_view body = bytes.substr(header.size_bytes);
    if (header.encoding == PlyEncoding::ascii) return visit(PlyTextBody(body));
    const bool is_big = header.encoding == PlyEncoding::big_endian;
    return visit(PlyBinaryBody(body, is_big ? std::endian::big : std::endian::little));
}

} // namespace vcarve
