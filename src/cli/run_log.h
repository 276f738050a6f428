#pragma once

#include "pipeline/predicted_time.h"
#include "vcarve/log.h"

#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace vcarve::cli {

/// What a command tells its user beside what the library tells its log. This one shows nothing.
class RunLog : public Log {
  public:
    /// How long the run is expected to take. It may be told again, when more is known.
    virtual void expect(const PredictedTimes& /*times*/) {}
    /// The run is over, and this is what to remember of it.
    virtual void conclude(std::string_view /*sentence*/) {}
};

/// What each stage counted, the last time it ran.
using CountsOfStages = std::map<std::string, Counts, std::less<>>;

/// Hands everything on to another log, and keeps what the stages count.
class CountsKeeper final : public Log {
  public:
    explicit CountsKeeper(Log& shown) : shown_(shown) {}

    void stage_begins(std::string_view name) override { shown_.stage_begins(name); }
    void stage_progresses(double share) override { shown_.stage_progresses(share); }
    void stage_ends(std::string_view name, const Counts& counts) override
    {
        counts_[std::string(name)] = counts;
        shown_.stage_ends(name, counts);
    }
    void note(std::string_view sentence) override { shown_.note(sentence); }
    bool wants_stop() const override { return shown_.wants_stop(); }

    const CountsOfStages& counts() const { return counts_; }

  private:
    Log& shown_;
    CountsOfStages counts_;
};

} // namespace vcarve::cli
