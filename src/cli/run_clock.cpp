#include "cli/run_clock.h"

#include <algorithm>
#include <utility>

namespace vcarve::cli {

void RunClock::expect(PredictedTimes times)
{
    expected_ = std::move(times);
    next_ = 0;
    taken_ = 0.0;
    expected_of_taken_ = 0.0;
    total_ = expected_later();
    if (is_running_) stage_begins(stage_, stage_began_s_);
}

void RunClock::stage_begins(std::string_view stage, double now_s)
{
    is_running_ = true;
    stage_ = stage;
    stage_began_s_ = now_s;
    const auto begin = expected_.stages.begin() + static_cast<std::ptrdiff_t>(next_);
    const auto at = std::find_if(begin, expected_.stages.end(),
                                 [&](const StageTime& each) { return each.stage == stage; });
    is_expected_ = at != expected_.stages.end();
    if (is_expected_) next_ = static_cast<std::size_t>(at - expected_.stages.begin()) + 1;
}

void RunClock::stage_ends(const Counts& counts, double now_s)
{
    if (is_telling()) {
        taken_ += now_s - stage_began_s_;
        expected_of_taken_ += expected_of_stage();
    }
    is_running_ = false;
    is_expected_ = false;
    // What a stage counts first is its result.
    if (expected_.points <= 0.0 || counts.empty() || counts.front().first != "points") return;
    const auto points = static_cast<double>(counts.front().second);
    for (std::size_t i = next_; i < expected_.stages.size(); ++i) {
        expected_.stages[i].seconds *= points / expected_.points;
    }
    expected_.points = points;
}

double RunClock::expected_of_stage() const
{
    return is_expected_ ? expected_.stages[next_ - 1].seconds : 0.0;
}

/// Whether the running stage is long enough to tell how slow a run is. Reading, for example, is
/// mostly short, and then depends on the disk.
bool RunClock::is_telling() const
{
    constexpr double kTelling = 0.02;
    return is_expected_ && expected_of_stage() >= kTelling * total_;
}

double RunClock::expected_later() const
{
    double seconds = 0.0;
    for (std::size_t i = next_; i < expected_.stages.size(); ++i) {
        seconds += expected_.stages[i].seconds;
    }
    return seconds;
}

/// Seconds taken over those expected, of all that is done; close to 1 while that is little.
double RunClock::slowness(double stage_share, double stage_seconds) const
{
    constexpr double kTrusted = 0.01; // of all seconds expected count as if they had been taken
    // A stage tells more the more of it is done: shares are of work, not of time.
    const double weight = is_telling() ? stage_share : 0.0;
    const double taken = taken_ + weight * stage_seconds;
    const double expected = expected_of_taken_ + weight * stage_share * expected_of_stage();
    const double trusted = kTrusted * total_;
    return expected + trusted > 0.0 ? (taken + trusted) / (expected + trusted) : 1.0;
}

/// By what is expected while little of the stage is done, by its own pace when most is.
double RunClock::left_of_stage(double stage_share, double stage_seconds, double slowness) const
{
    const double expected = slowness * expected_of_stage();
    if (stage_share <= 0.0) {
        // A stage that is late is not about to end.
        constexpr double kLate = 0.1;
        return std::max(expected - stage_seconds, kLate * stage_seconds);
    }
    const double left = 1.0 - stage_share;
    if (!is_expected_) return left * stage_seconds / stage_share;
    return left * (left * expected + stage_seconds);
}

std::optional<RunEstimate> RunClock::estimate(double stage_share, double now_s)
{
    if (expected_.stages.empty()) return std::nullopt;
    const double stage_seconds = is_running_ ? now_s - stage_began_s_ : 0.0;
    const double slow = slowness(stage_share, stage_seconds);
    double left = slow * expected_later();
    if (is_running_) left += left_of_stage(stage_share, stage_seconds, slow);
    const double all = now_s + left;
    if (all > 0.0) share_ = std::max(share_, now_s / all);
    return RunEstimate{.share = share_, .left_seconds = left};
}

} // namespace vcarve::cli
