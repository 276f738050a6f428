#pragma once

#include <nlohmann/json.hpp>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace vcarve::bench {

using Json = nlohmann::ordered_json;

/// Does the work in a forked process and returns its result, so that memory and threads of one
/// measurement do not affect the next. Throws std::runtime_error with the message of any exception
/// of the work. The calling process must not have started threads.
Json in_own_process(const std::function<Json()>& work);

/// Runs the program `words[0]` to its end and returns its costs: {"seconds", "cpu_seconds",
/// "peak_bytes"}. They include processes that the program starts and waits for; the peak is that of
/// the largest process. Throws std::runtime_error if the exit code is not 0.
Json measure_program(const std::vector<std::string>& words);

} // namespace vcarve::bench
