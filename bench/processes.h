#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vcarve::bench {

using Json = nlohmann::ordered_json;

/// Does the work in a process of its own, which begins as a copy of this one and ends with the
/// work: so memory that one measurement leaves behind, or threads, are not met by the next. Returns
/// what the work returns. Throws std::runtime_error with the message of what it throws. This
/// process must not have started threads.
Json in_own_process(const std::function<Json()>& work);

/// Runs a program, `words[0]`, to its end and returns what it took: {"seconds", "cpu_seconds",
/// "peak_bytes", "scratch_bytes", "written_bytes", "read_bytes"}. Of a program that runs others and
/// waits for them the peak is that of the largest process, and all else that of all together. The
/// scratch is the most that the files in a folder took on disk at once, looked at fifty times a
/// second; the folder need not be there at any time. Written and read is what the program asked of
/// the system, or, where that is more, what went to disk and came from it: files that are mapped
/// into memory show there only. Throws std::runtime_error where the program does not end with exit
/// code 0.
Json measure_program(const std::vector<std::string>& words, const std::filesystem::path& scratch);

} // namespace vcarve::bench
