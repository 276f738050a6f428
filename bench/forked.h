#pragma once

#include <nlohmann/json.hpp>

#include <functional>

namespace vcarve::bench {

using Json = nlohmann::ordered_json;

/// Does the work in a process of its own, which begins as a copy of this one and ends with the
/// work: so memory that one measurement leaves behind, or threads, are not met by the next. Returns
/// what the work returns. Throws std::runtime_error with the message of what it throws. This
/// process must not have started threads.
Json in_own_process(const std::function<Json()>& work);

} // namespace vcarve::bench
