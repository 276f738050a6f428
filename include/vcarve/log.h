#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

/// Named counts of what a stage did, in the order they are to be read: {"points", 3012}.
using Counts = std::vector<std::pair<std::string, std::int64_t>>;

/// Where a run tells what it does, and asks whether it should go on. The library prints nothing
/// itself; the program, or whoever uses the library, decides what to show. The default shows
/// nothing and never stops a run.
class Log {
  public:
    virtual ~Log() = default;

    /// A stage begins; the one before has ended. Called by the thread that started the run.
    virtual void stage_begins(std::string_view /*name*/) {}
    /// Share of the running stage that is done, 0 to 1: larger than the one told before, 1 at the
    /// end of a stage that tells any. Called from any thread, by one at a time. A share is a share
    /// of work that is counted, and about one of time.
    virtual void stage_progresses(double /*share*/) {}
    /// A stage has ended, with what it counted. Called by the thread that started the run.
    virtual void stage_ends(std::string_view /*name*/, const Counts& /*counts*/) {}
    /// One sentence the user should read, though the run goes on.
    virtual void note(std::string_view /*sentence*/) {}
    /// Whether the run should stop: then it ends by throwing Cancelled. Asked from any thread, by
    /// many at a time and some thousand times a second, so it must be quick and safe to call so:
    /// `return source.stop_requested();` of a std::stop_source, for example.
    virtual bool wants_stop() const { return false; }
};

} // namespace vcarve
