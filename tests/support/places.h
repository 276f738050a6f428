#pragma once

#include <filesystem>
#include <string>

namespace vcarve {

std::filesystem::path fixtures_folder();

/// colmap-vcarve as it was built beside the tests.
std::string built_program();

/// The library of failing_calls.cpp; empty in sanitized builds, which load one of their own first.
std::string failing_calls_library();

} // namespace vcarve
