#pragma once

#include "forked.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::bench {

/// Runs a program, `words[0]`, to its end and returns what it took: {"seconds", "cpu_seconds",
/// "peak_bytes", "scratch_bytes", "written_bytes", "read_bytes"}. Of a program that runs others and
/// waits for them the peak is that of the largest process, and all else that of all together. The
/// scratch is the most that the files in a folder took on disk at once, looked at fifty times a
/// second; the folder need not be there at any time. Written and read is what the program asked of
/// the system, or, where that is more, what went to disk and came from it: files that are mapped
/// into memory show there only. Throws std::runtime_error where the program does not end with exit
/// code 0.
Json measure_program(const std::vector<std::string>& words, const std::filesystem::path& scratch);

/// A figure of it that is in bytes, in megabytes.
std::string megabytes(const Json& figures, const char* name);

/// Whether two files are equal, as what two runs wrote should be.
bool have_same_bytes(const std::filesystem::path& a, const std::filesystem::path& b);

} // namespace vcarve::bench
