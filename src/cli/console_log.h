#pragma once

#include "base/log.h"

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
    bool live = false;      ///< the stream is a terminal: show a bar while a stage runs
    double bar_after_s = 1; ///< stages that end sooner show no bar
};

/// Settings for stderr; live where it is a terminal that can move its cursor.
ConsoleSettings console_on_stderr();

/// Prints one line a stage when it ends, with counts and seconds, and `note: ...` for each note.
/// Where the stream is live a bar runs in the last line while a stage takes longer.
class ConsoleLog final : public Log {
  public:
    explicit ConsoleLog(const ConsoleSettings& settings);
    ConsoleLog(const ConsoleLog&) = delete;
    ConsoleLog& operator=(const ConsoleLog&) = delete;
    ~ConsoleLog() override;

    void stage_begins(std::string_view name) override;
    void stage_progresses(double share) override;
    void stage_ends(std::string_view name, const Counts& counts) override;
    void note(std::string_view sentence) override;

  private:
    using Clock = std::chrono::steady_clock;

    void keep_bar_moving();
    void draw_bar();
    void remove_bar();
    double stage_seconds() const;

    const ConsoleSettings settings_;
    std::atomic<double> share_ = 0.0;
    std::mutex mutex_; ///< guards what follows, and the stream
    std::condition_variable woken_;
    std::string stage_; ///< empty between stages
    Clock::time_point stage_began_;
    bool bar_is_drawn_ = false;
    bool ends_ = false;
    std::thread ticker_;
};

/// "24,310 of 25,784 points (1,102 few views, 372 high error)": the first count is the stage's
/// result; a second one named "of" is what it was taken from; others follow in brackets unless they
/// are 0.
std::string counts_text(const Counts& counts);

/// "filter       24,310 of 25,784 points (1,102 few views)         0.03 s"
std::string stage_line(std::string_view name, const Counts& counts, double seconds);

/// "cut          [=======>            ]  38 %  12 s", no wider than `columns`; without a bar while
/// the share done is 0.
std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns);

} // namespace vcarve::cli
