#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace vcarve {

/// A kind of count. The key identifies it among the counts of a stage. In its text, {} is the
/// count, {of} its total, and {milli} a thousandth of it.
struct CountKind {
    std::string_view key;     ///< in records: "few views"
    std::string_view text;    ///< in the log: ", {} few views"; empty: not shown
    std::string_view meaning; ///< for people
    bool always = false;      ///< shown even if it is 0 or there is no room
};

/// The total of a count that has none.
inline constexpr std::int64_t kNoTotal = -1;

/// A result of a stage.
struct Count {
    CountKind kind;             ///< what is counted
    std::int64_t value = 0;     ///< the number
    std::int64_t of = kNoTotal; ///< the total of which `value` is a part
    std::string subject = {};   ///< the mesh whose faces are counted, for example; often empty

    /// "faces", or "faces of SUBJECT".
    std::string name() const
    {
        return std::string(kind.key) + (subject.empty() ? "" : " of " + subject);
    }
};

/// The results of a stage, in display order.
using Counts = std::vector<Count>;

/// The count of a kind; null if there is none.
inline const Count* find_count(const Counts& counts, const CountKind& kind)
{
    const auto key_of = [](const Count& count) { return count.kind.key; };
    const auto found = std::ranges::find(counts, kind.key, key_of);
    return found == counts.end() ? nullptr : &*found;
}

/// Calls take(name, number) as records have them: ("points", 3133), ("of points", 3243).
template <typename Take>
void for_each_number(const Counts& counts, const Take& take)
{
    for (const Count& count : counts) {
        take(count.name(), count.value);
        if (count.of != kNoTotal) take("of " + count.name(), count.of);
    }
}

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
