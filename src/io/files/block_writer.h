#pragma once

#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <ostream>
#include <string>
#include <vector>

namespace vcarve {

/// The first word of the comment with the vector that was subtracted from all positions.
inline constexpr const char* kOffsetWord = "offset";

/// The comment lines of a file: the offset unless it is zero, in the form that read_ply() parses,
/// then the comments. Line breaks become blanks.
inline std::vector<std::string> comment_lines(const MeshFormat& format)
{
    std::vector<std::string> lines;
    if (!format.offset.isZero(0.0)) {
        lines.push_back(fmt::format("{} {} {} {}", kOffsetWord, format.offset.x(),
                                    format.offset.y(), format.offset.z()));
    }
    lines.insert(lines.end(), format.comments.begin(), format.comments.end());
    for (std::string& line : lines) {
        std::ranges::replace_if(
            line, [](char c) { return c == '\n' || c == '\r'; }, ' ');
    }
    return lines;
}

/// Buffers bytes and writes them to the stream in large blocks.
class BlockWriter {
  public:
    explicit BlockWriter(std::ostream& out) : out_(out) {}
    ~BlockWriter() { out_.write(block_.data(), static_cast<std::streamsize>(block_.size())); }
    BlockWriter(const BlockWriter&) = delete;
    BlockWriter& operator=(const BlockWriter&) = delete;

    /// The buffer to append to. Each call first writes a full buffer to the stream.
    fmt::memory_buffer& block()
    {
        if (block_.size() > kBlockBytes) {
            out_.write(block_.data(), static_cast<std::streamsize>(block_.size()));
            block_.clear();
        }
        return block_;
    }

  private:
    static constexpr std::size_t kBlockBytes = 1 << 20;

    std::ostream& out_;
    fmt::memory_buffer block_;
};

/// The bytes of a number, lowest byte first on any machine.
template <typename Number>
std::array<char, sizeof(Number)> little_endian(Number number)
{
    std::array<char, sizeof(Number)> bytes;
    std::memcpy(bytes.data(), &number, sizeof(Number));
    if constexpr (std::endian::native == std::endian::big) std::ranges::reverse(bytes);
    return bytes;
}

template <typename Number>
void put_little_endian(fmt::memory_buffer& block, Number number)
{
    const auto bytes = little_endian(number);
    block.append(bytes.data(), bytes.data() + bytes.size());
}

} // namespace vcarve
