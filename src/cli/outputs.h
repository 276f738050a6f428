#pragma once

#include <filesystem>
#include <span>

namespace vcarve::cli {

/// A file that a command writes, and what it is called in messages.
struct Output {
    const char* name;
    std::filesystem::path path;
};

/// Throws UsageError where two outputs would be one file.
void require_distinct(std::span<const Output> outputs);

} // namespace vcarve::cli
