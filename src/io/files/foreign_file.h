#pragma once

#include <filesystem>
#include <span>

namespace vcarve {

/// Throws InputError where the beginning of a file shows that something else lies in its place: a
/// Git LFS pointer, a web page, an archive. The sentence says what to do.
void refuse_foreign_file(const std::filesystem::path& path, std::span<const char> bytes);

/// The same by the end of the name: files of points or meshes that are not read, such as .las.
void refuse_foreign_name(const std::filesystem::path& path);

/// Whether a name ends as those of photographs do.
bool has_image_name(const std::filesystem::path& path);

} // namespace vcarve
