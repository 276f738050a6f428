#include "cli/console_log.h"

#include "base/grouped_digits.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace vcarve::cli {

namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarCells = 30;
constexpr const char* kClearLine = "\r\x1b[K";

std::size_t columns_of(std::FILE* stream)
{
    winsize size = {};
    const bool known = ::ioctl(::fileno(stream), TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : 80;
}

} // namespace

ConsoleSettings console_on_stderr()
{
    const char* terminal = std::getenv("TERM");
    const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
    return {.stream = stderr, .live = can_redraw && ::isatty(STDERR_FILENO) != 0};
}

std::string counts_text(const Counts& counts)
{
    if (counts.empty()) return "";
    const bool has_whole = counts.size() > 1 && counts[1].first == "of";
    std::string text = grouped_digits(counts[0].second);
    if (has_whole) text += " of " + grouped_digits(counts[1].second);
    text += " " + counts[0].first;

    std::string others;
    for (std::size_t i = has_whole ? 2 : 1; i < counts.size(); ++i) {
        if (counts[i].second == 0) continue;
        others += others.empty() ? "" : ", ";
        others += grouped_digits(counts[i].second) + " " + counts[i].first;
    }
    return others.empty() ? text : fmt::format("{} ({})", text, others);
}

std::string stage_line(std::string_view name, const Counts& counts, double seconds)
{
    return fmt::format("{:<12} {:<62} {:>8.2f} s", name, counts_text(counts), seconds);
}

std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns)
{
    const double done = std::clamp(share, 0.0, 1.0);
    std::string line = fmt::format("{:<12} ", name);
    if (done > 0.0) {
        const auto filled = static_cast<std::size_t>(done * static_cast<double>(kBarCells));
        std::string bar = std::string(filled, '=') + ">";
        bar.resize(kBarCells, ' ');
        line += fmt::format("[{}] {:>3.0f} %  ", bar, 100.0 * done);
    }
    line += fmt::format("{:.0f} s", seconds);
    // A line as wide as the terminal would scroll it.
    if (columns > 0 && line.size() >= columns) line.resize(columns - 1);
    return line;
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

void ConsoleLog::draw_bar()
{
    const std::string line =
        bar_line(stage_, share_.load(), stage_seconds(), columns_of(settings_.stream));
    fmt::print(settings_.stream, "{}{}", kClearLine, line);
    std::fflush(settings_.stream);
    bar_is_drawn_ = true;
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
        if (!ends_ && !stage_.empty() && stage_seconds() >= settings_.bar_after_s) draw_bar();
    }
}

void ConsoleLog::stage_begins(std::string_view name)
{
    {
        const std::lock_guard lock(mutex_);
        stage_ = name;
        stage_began_ = Clock::now();
        share_ = 0.0;
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
    remove_bar();
    fmt::print(settings_.stream, "{}\n", stage_line(name, counts, stage_seconds()));
    std::fflush(settings_.stream);
    stage_.clear();
}

void ConsoleLog::note(std::string_view sentence)
{
    const std::lock_guard lock(mutex_);
    remove_bar();
    fmt::print(settings_.stream, "note: {}\n", sentence);
    std::fflush(settings_.stream);
}

} // namespace vcarve::cli
