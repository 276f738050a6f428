#pragma once

#include <filesystem>
#include <system_error>

namespace vcarve {

/// Whether there is a file, or a folder, that links lead to; what cannot be asked is none.
inline bool is_file(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_regular_file(path, error);
}

inline bool is_folder(const std::filesystem::path& path)
{
    std::error_code error;
    return std::filesystem::is_directory(path, error);
}

} // namespace vcarve
