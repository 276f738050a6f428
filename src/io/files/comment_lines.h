#pragma once

#include "vcarve/io.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

namespace vcarve {

/// Begins the comment that says what was subtracted from the positions of a file.
inline constexpr const char* kOffsetWord = "offset";

/// What is said in a file, one line each: the offset, which read_ply() understands again, where
/// there is one, and the comments. What would break a line becomes a blank.
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

} // namespace vcarve
