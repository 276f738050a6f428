#include "cli/console_log.h"

#include "base/text.h"
#include "cli/stage_lines.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace vcarve::cli {

namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarCells = 30;
constexpr const char* kClearLine = "\r\x1b[K";
constexpr const char* kBold = "\x1b[1m";
constexpr const char* kPlain = "\x1b[0m";

std::size_t columns_of(std::FILE* stream)
{
    winsize size = {};
    const bool known = ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

/// "[=====>      ]"
std::string bar_of(double share, std::size_t cells)
{
    const double done = std::clamp(share, 0.0, 1.0);
    const auto filled = static_cast<std::size_t>(done * static_cast<double>(cells));
    std::string bar = std::string(filled, '=') + ">";
    bar.resize(cells, ' ');
    return "[" + bar + "]";
}

/// A line as wide as the terminal would scroll it.
std::string narrower(std::string line, std::size_t columns)
{
    if (columns > 0 && line.size() >= columns) line.resize(columns - 1);
    return line;
}

/// What is left of a run, no more exact than it is known.
std::string time_text(double seconds)
{
    constexpr double kMinute = 60.0;
    constexpr double kHour = 60.0 * kMinute;
    if (seconds < 1.5 * kMinute) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
    if (seconds < 1.5 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
    return fmt::format("{:.0f} h", seconds / kHour);
}

} // namespace

ConsoleSettings console_on_stderr(bool verbose)
{
    const char* terminal = std::getenv("TERM");
    const char* no_color = std::getenv("NO_COLOR");
    const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
    const bool live = can_redraw && ::isatty(STDERR_FILENO) != 0;
    return {.stream = stderr,
            .live = live,
            .verbose = verbose,
            .emphasis = live && (no_color == nullptr || *no_color == '\0')};
}

std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns)
{
    std::string line = fmt::format("{:<12} ", name);
    if (share > 0.0) {
        line +=
            fmt::format("{} {:>3.0f} %  ", bar_of(share, kBarCells), 100.0 * std::min(share, 1.0));
    }
    line += fmt::format("{:.0f} s", seconds);
    return narrower(std::move(line), columns);
}

std::string run_line(std::string_view stage, const RunEstimate& run, std::size_t columns)
{
    constexpr std::size_t kLeastCells = 5;
    const std::string name = fmt::format("{:<12} ", stage);
    // A run is over when it is: until then it is not shown as full.
    const double percent = std::min(std::floor(100.0 * run.share), 99.0);
    const std::string figures =
        fmt::format("{:>3.0f} %  {} left", percent, time_text(run.left_seconds));
    const std::size_t beside = name.size() + figures.size() + 4; // brackets, a blank, the cursor
    const std::size_t cells =
        columns == 0 ? kBarCells : std::min(kBarCells, columns - std::min(columns, beside));
    const std::string bar = cells < kLeastCells ? "" : bar_of(run.share, cells) + " ";
    return narrower(name + bar + figures, columns);
}

ConsoleLog::ConsoleLog(const ConsoleSettings& settings) : settings_(settings)
{
    if (settings_.live) ticker_ = std::thread([this] { keep_bar_moving(); });
}

ConsoleLog::~ConsoleLog()
{
    {
        const std::lock_guard lock(mutex_);
        ends_ = true;
        remove_bar();
    }
    woken_.notify_all();
    if (ticker_.joinable()) ticker_.join();
}

double ConsoleLog::stage_seconds() const
{
    return std::chrono::duration<double>(Clock::now() - stage_began_).count();
}

void ConsoleLog::remove_bar()
{
    if (!bar_is_drawn_) return;
    std::fputs(kClearLine, settings_.stream);
    std::fflush(settings_.stream);
    bar_is_drawn_ = false;
}

double ConsoleLog::run_seconds() const
{
    return std::chrono::duration<double>(Clock::now() - run_began_).count();
}

/// What is to be shown now; empty for nothing.
std::string ConsoleLog::bar()
{
    const std::size_t columns = columns_of(settings_.stream);
    const double seconds = run_seconds();
    const auto run = clock_.estimate(share_.load(), seconds);
    if (!run) {
        if (stage_seconds() < settings_.bar_after_s) return "";
        return bar_line(stage_, share_.load(), stage_seconds(), columns);
    }
    run_is_long_ = run_is_long_ || seconds + run->left_seconds > settings_.run_bar_after_s;
    return run_is_long_ ? run_line(stage_, *run, columns) : "";
}

void ConsoleLog::draw_bar()
{
    const std::string line = bar();
    if (line.empty()) return;
    std::fputs((kClearLine + line).c_str(), settings_.stream);
    std::fflush(settings_.stream);
    bar_is_drawn_ = true;
}

void ConsoleLog::print_line(std::string_view text)
{
    remove_bar();
    // What cannot be written is dropped: nobody reads it, but somebody waits for the mesh.
    std::fputs(fmt::format("{}\n", text).c_str(), settings_.stream);
    std::fflush(settings_.stream);
}

std::string ConsoleLog::emphasised(std::string_view text) const
{
    return settings_.emphasis ? fmt::format("{}{}{}", kBold, text, kPlain) : std::string(text);
}

void ConsoleLog::keep_bar_moving()
{
    std::unique_lock lock(mutex_);
    while (!ends_) {
        if (stage_.empty()) {
            woken_.wait(lock);
            continue;
        }
        woken_.wait_for(lock, kRedraw);
        if (!ends_ && !stage_.empty()) draw_bar();
    }
}

void ConsoleLog::stage_begins(std::string_view name)
{
    {
        const std::lock_guard lock(mutex_);
        stage_ = settings_.verbose ? name : stage_words(name, {}).name;
        stage_began_ = Clock::now();
        share_ = 0.0;
        clock_.stage_begins(name, run_seconds());
    }
    woken_.notify_all();
}

void ConsoleLog::stage_progresses(double share)
{
    share_ = share;
}

void ConsoleLog::stage_ends(std::string_view name, const Counts& counts)
{
    const std::lock_guard lock(mutex_);
    const StageWords words = settings_.verbose ? StageWords{std::string(name), counts_text(counts)}
                                               : stage_words(name, counts);
    if (words.is_shown) print_line(control_free(stage_line(words, stage_seconds())));
    clock_.stage_ends(counts, run_seconds());
    stage_.clear();
}

void ConsoleLog::note(std::string_view sentence)
{
    const std::lock_guard lock(mutex_);
    print_line(fmt::format("{} {}", emphasised("note:"), control_free(sentence)));
}

void ConsoleLog::expect(const PredictedTimes& times)
{
    const std::lock_guard lock(mutex_);
    clock_.expect(times);
    constexpr double kLong = 120.0;
    double seconds = 0.0;
    for (const StageTime& stage : times.stages) {
        seconds += stage.seconds;
    }
    if (seconds < kLong || std::exchange(is_said_long_, true)) return;
    const auto& longest = *std::ranges::max_element(times.stages, {}, &StageTime::seconds);
    print_line(fmt::format("{} this may take {}, of which {} takes {}", emphasised("note:"),
                           time_text(seconds), longest.stage, time_text(longest.seconds)));
}

void ConsoleLog::conclude(std::string_view sentence)
{
    const std::lock_guard lock(mutex_);
    print_line(emphasised(sentence));
}

} // namespace vcarve::cli
