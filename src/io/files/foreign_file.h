#pragma once

#include <filesystem>
#include <span>

namespace vcarve {

/// Throws InputError if the first bytes show that the file is a Git LFS pointer, a web page or an
/// archive. The message names the remedy.
void refuse_foreign_file(const std::filesystem::path& path, std::span<const char> bytes);

/// Throws InputError if the extension is that of an unsupported model, cloud or mesh (.las, .nvm).
void refuse_foreign_name(const std::filesystem::path& path);

/// Whether the extension is that of a photograph, in any case.
bool has_image_name(const std::filesystem::path& path);

} // namespace vcarve
