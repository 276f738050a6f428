#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

/// Named counts of what a stage did, in the order they are to be read: {"points", 3012}.
using Counts = std::vector<std::pair<std::string, std::int64_t>>;

/// The size of a container, as a count.
inline std::int64_t size_of(std::size_t count)
{
    return static_cast<std::int64_t>(count);
}

/// Where a run tells what it does. The library prints nothing itself; the program, or whoever uses
/// the library, decides what to show. The default shows nothing.
class Log {
  public:
    virtual ~Log() = default;

    virtual void stage_begins(std::string_view /*name*/) {}
    /// Share of the running stage that is done, 0 to 1. May be called from any thread.
    virtual void stage_progresses(double /*share*/) {}
    virtual void stage_ends(std::string_view /*name*/, const Counts& /*counts*/) {}
    /// One sentence the user should read, though the run goes on.
    virtual void note(std::string_view /*sentence*/) {}
};

/// One stage of a run: tells the log when it begins and, unless it failed, when it ends.
class Stage {
  public:
    Stage(Log& log, std::string_view name) : log_(log), name_(name) { log_.stage_begins(name_); }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    void progress(double share) { log_.stage_progresses(share); }
    /// Ends the stage with what it counted. Call it once, when the work is done.
    void end(const Counts& counts) { log_.stage_ends(name_, counts); }

  private:
    Log& log_;
    std::string name_;
};

} // namespace vcarve
