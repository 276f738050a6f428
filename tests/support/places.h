#pragma once

#include <filesystem>
#include <string>

namespace vcarve {

std::filesystem::path fixtures_folder();

/// The colmap-vcarve that was built with the tests.
std::string built_program();

/// The library of failing_calls.cpp; empty in sanitized builds, which preload another library.
std::string failing_calls_library();

} // namespace vcarve
