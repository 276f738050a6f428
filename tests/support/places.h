#pragma once

#include <filesystem>
#include <string>

namespace vcarve {

std::filesystem::path fixtures_folder();

/// colmap-vcarve as it was built beside the tests.
std::string built_program();

} // namespace vcarve
