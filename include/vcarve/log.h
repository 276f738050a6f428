#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

/// Named results of a stage, in display order, such as {"points", 3012}.
using Counts = std::vector<std::pair<std::string, std::int64_t>>;

/// Receives the progress of a run, and can stop the run. The library prints nothing; the caller
/// decides what to show. The default shows nothing and never stops a run.
class Log {
  public:
    virtual ~Log() = default;

    /// A stage begins; the previous stage has ended. Called on the thread that started the run.
    virtual void stage_begins(std::string_view /*name*/) {}
    /// The finished share of the running stage, from 0 to 1. Shares increase; a stage that reports
    /// any ends with 1. A share measures counted work, which is roughly proportional to time.
    /// Called on any thread, but never concurrently.
    virtual void stage_progresses(double /*share*/) {}
    /// A stage has ended with these counts. Called on the thread that started the run.
    virtual void stage_ends(std::string_view /*name*/, const Counts& /*counts*/) {}
    /// A one-sentence warning or hint for the user. The run continues.
    virtual void note(std::string_view /*sentence*/) {}
    /// Whether the run should stop, by throwing Cancelled. Called on many threads concurrently,
    /// some thousand times per second, so it must be fast and thread-safe. An example is
    /// `source.stop_requested()` of a std::stop_source.
    virtual bool should_stop() const { return false; }
};

} // namespace vcarve
