#pragma once

#include "cli/run_clock.h"
#include "cli/run_log.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <thread>

namespace vcarve::cli {

/// How a run is shown.
struct ConsoleSettings {
    std::FILE* stream = stderr;
    bool live = false;          ///< the stream is a terminal: show a bar while a run goes on
    bool verbose = false;       ///< every stage and all its counts are told
    bool emphasis = false;      ///< what should not be missed is bold
    double bar_after_s = 1;     ///< stages that end sooner show no bar where nothing is expected
    double run_bar_after_s = 5; ///< runs that end sooner show none where their time is expected
};

/// Settings for stderr: live where it is a terminal that can move its cursor, with emphasis where
/// moreover the environment does not forbid it: NO_COLOR is not set, or empty (no-color.org).
ConsoleSettings console_on_stderr(bool verbose);

/// Prints one line a stage when it ends, see stage_words, with seconds, and `note: ...` for each
/// note. Where the stream is live a bar runs in the last line: of the whole run, with what is left
/// of its time, where that is expected to be long, or takes long; where nothing is expected, of a
/// stage that takes longer. To other streams it writes plain lines: no carriage return, no escape.
class ConsoleLog final : public RunLog {
  public:
    explicit ConsoleLog(const ConsoleSettings& settings);
    ConsoleLog(const ConsoleLog&) = delete;
    ConsoleLog& operator=(const ConsoleLog&) = delete;
    ~ConsoleLog() override;

    void stage_begins(std::string_view name) override;
    void stage_progresses(double share) override;
    void stage_ends(std::string_view name, const Counts& counts) override;
    void note(std::string_view sentence) override;
    void expect(const PredictedTimes& times) override;
    void conclude(std::string_view sentence) override;

  private:
    using Clock = std::chrono::steady_clock;

    void keep_bar_moving();
    void draw_bar();
    void remove_bar();
    std::string bar();
    void print_line(std::string_view text);
    std::string emphasised(std::string_view text) const;
    double stage_seconds() const;
    double run_seconds() const;

    const ConsoleSettings settings_;
    const Clock::time_point run_began_ = Clock::now();
    std::atomic<double> share_ = 0.0;
    std::mutex mutex_; ///< guards what follows, and the stream
    std::condition_variable woken_;
    std::string stage_; ///< empty between stages
    Clock::time_point stage_began_;
    RunClock clock_;
    bool run_is_long_ = false;
    bool is_said_long_ = false;
    bool bar_is_drawn_ = false;
    bool ends_ = false;
    std::thread ticker_;
};

/// "cut          [=======>            ]  38 %  12 s", no wider than `columns`; without a bar while
/// the share done is 0.
std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns);

/// "cut          [=======>            ]  38 %  12 s left": the stage that runs, and how far the run
/// is. The bar is shorter where there are fewer than 64 columns, and missing where there are few.
std::string run_line(std::string_view stage, const RunEstimate& run, std::size_t columns);

} // namespace vcarve::cli
