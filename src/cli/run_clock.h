#pragma once

#include "pipeline/predicted_time.h"
#include "vcarve/log.h"

#include <cstddef>
#include <optional>
#include <string_view>

namespace vcarve::cli {

/// How far a run is.
struct RunEstimate {
    double share;        ///< of its time that has passed, 0 to 1
    double left_seconds; ///< that it will still take
};

/// Says how far a run is, from what was expected of it and from what it took up to now: once a
/// stage is over, or is partly over, its share of slowness holds for what is to come, and the stage
/// that runs is also judged by its own pace. Where points turn out to be fewer or more than
/// expected, so is what is to come. Stages that were expected and do not come are forgotten when a
/// later one begins; those that come unexpectedly count while they run. Time is given to it, in
/// seconds since the run began, so that it is the same for any clock.
class RunClock {
  public:
    /// What is expected of the whole run. Where a stage runs already, it is found among them. May
    /// be called again, when more is known.
    void expect(PredictedTimes times);
    void stage_begins(std::string_view stage, double now_s);
    void stage_ends(const Counts& counts, double now_s);

    /// `stage_share` is that of the running stage which is done, 0 where it is not known. Nothing
    /// while nothing is expected. The share never falls from one call to the next.
    std::optional<RunEstimate> estimate(double stage_share, double now_s);

  private:
    double expected_of_stage() const;
    bool is_telling() const;
    double expected_later() const;
    double slowness(double stage_share, double stage_seconds) const;
    double left_of_stage(double stage_share, double stage_seconds, double slowness) const;

    PredictedTimes expected_;
    double total_ = 0.0;       ///< seconds that were expected of all stages
    std::size_t next_ = 0;     ///< the first of the expected stages that has not begun
    bool is_running_ = false;  ///< a stage
    bool is_expected_ = false; ///< the running stage is the one before next_
    std::string stage_;
    double stage_began_s_ = 0.0;
    double taken_ = 0.0;             ///< by telling stages that are over
    double expected_of_taken_ = 0.0; ///< what was expected of these
    double share_ = 0.0;             ///< told last
};

} // namespace vcarve::cli
