#pragma once

#include "vcarve/log.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <thread>

namespace vcarve::cli {

/// The counts of each stage, of its last run.
using CountsOfStages = std::map<std::string, Counts, std::less<>>;

/// Settings of the console output.
struct ConsoleSettings {
    std::FILE* stream = stderr;
    bool live = false;      ///< the stream is a terminal: show a bar
    bool quiet = false;     ///< show nothing
    bool verbose = false;   ///< show every stage and all its counts
    bool emphasis = false;  ///< bold notes
    double bar_after_s = 1; ///< shorter stages show no bar
};

/// Settings for stderr: live on a terminal that can move its cursor, with emphasis unless NO_COLOR
/// is set and not empty (no-color.org).
ConsoleSettings console_on_stderr(bool quiet, bool verbose);

/// Prints one line per stage when it ends (see stage_words), with seconds, and `note: ...` for each
/// note. On a live stream the last line is a bar of a long stage, with the time left. Other streams
/// get plain lines, without carriage returns and escape sequences.
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
    /// Prints the result of the run.
    void conclude(std::string_view sentence);

    const CountsOfStages& counts() const { return counts_; }

  private:
    using Clock = std::chrono::steady_clock;

    void keep_bar_moving();
    void draw_bar();
    void remove_bar();
    void print_line(std::string_view text);
    std::string emphasised(std::string_view text) const;
    double stage_seconds() const;

    const ConsoleSettings settings_;
    CountsOfStages counts_;
    std::atomic<double> share_ = 0.0;
    std::mutex mutex_; ///< guards the stream and the members below
    std::condition_variable woken_;
    std::string stage_; ///< empty between stages
    Clock::time_point stage_began_;
    bool bar_is_drawn_ = false;
    bool ends_ = false;
    std::thread ticker_;
};

/// "cut          [=======>            ]  38 %  about 12 s left", narrower than `columns`. Shows the
/// elapsed seconds while the share is small, and no bar while it is 0.
std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns);

/// Joins the texts of a stage's counts: "2,920 vertices moved within their error (0.27 px)". Texts
/// after the first are omitted if the count is 0 or there is no room, unless they are always shown.
/// Returns nothing for a stage whose counts have no texts: it is shown only with --verbose.
std::optional<std::string> stage_words(const Counts& counts);

/// Formats all counts: "24,310 of 25,784 points (1,102 few views, 372 high error)". The first is
/// the result. Others follow in brackets unless they are 0.
std::string counts_text(const Counts& counts);

} // namespace vcarve::cli
