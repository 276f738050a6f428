#pragma once

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <string>

namespace vcarve {

/// What a file's name ends with, from its last dot on, in small letters: ".ply" of "a/B.PLY".
inline std::string lower_case_end(const std::filesystem::path& path)
{
    std::string end = path.extension().string();
    std::ranges::transform(end, end.begin(),
                           [](unsigned char letter) { return std::tolower(letter); });
    return end;
}

} // namespace vcarve
