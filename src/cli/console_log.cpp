#include "cli/console_log.h"

#include "base/text.h"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>

namespace vcarve::cli {

namespace {

constexpr auto kRedraw = std::chrono::milliseconds(100);
constexpr std::size_t kBarCells = 30;
constexpr const char* kClearLine = "\r\x1b[K";
constexpr const char* kBold = "\x1b[1m";
constexpr const char* kPlain = "\x1b[0m";
constexpr std::size_t kTextColumns = 55; ///< of 80; the others show name and seconds

/// Fills a number into a place of a text, and makes the noun after it singular if it is 1.
void fill_in(std::string& text, std::string_view place, std::int64_t number,
             const std::string& digits)
{
    const std::size_t at = text.find(place);
    if (at == std::string::npos) return;
    const std::size_t after = at + place.size();
    const std::size_t end = std::min(text.find_first_of(" ,)", after + 1), text.size());
    const std::string nouns = text.substr(after, end - after);
    if (number == 1 && nouns.starts_with(' ') && nouns.ends_with('s')) {
        text.replace(at, end - at, counted(1, nouns.substr(1)));
    } else {
        text.replace(at, place.size(), digits);
    }
}

/// Fills in the text of a count.
std::string text_of(const Count& count)
{
    std::string text(count.kind.text);
    fill_in(text, "{}", count.value, grouped_digits(count.value));
    fill_in(text, "{of}", count.of, grouped_digits(count.of));
    fill_in(text, "{milli}", count.value,
            fmt::format("{:.2f}", static_cast<double>(count.value) / 1000.0));
    return count.subject.empty() ? text : text + " of " + count.subject;
}

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

/// Formats an estimate, rounded to its precision.
std::string time_text(double seconds)
{
    constexpr double kMinute = 60.0;
    constexpr double kHour = 60.0 * kMinute;
    if (seconds < 1.5 * kMinute) return fmt::format("{:.0f} s", std::max(seconds, 1.0));
    if (seconds < 1.5 * kHour) return fmt::format("{:.0f} min", seconds / kMinute);
    return fmt::format("{:.0f} h", seconds / kHour);
}

} // namespace

std::optional<std::string> stage_words(const Counts& counts)
{
    if (counts.empty()) return "";
    std::optional<std::string> words;
    for (const Count& count : counts) {
        const std::string text = text_of(count);
        if (text.empty()) continue;
        const std::string longer = words.value_or("") + text;
        const bool fits = longer.size() <= kTextColumns;
        if (!words || count.kind.always || (count.value != 0 && fits)) words = longer;
    }
    return words;
}

std::string counts_text(const Counts& counts)
{
    std::string text;
    std::string others;
    for (const Count& count : counts) {
        const bool is_first = text.empty();
        if (!is_first && count.value == 0) continue;
        std::string& part = is_first ? text : others;
        if (!part.empty()) part += ", ";
        part += grouped_digits(count.value);
        if (count.of != kNoTotal) part += " of " + grouped_digits(count.of);
        part += " " + count.name();
    }
    return others.empty() ? text : fmt::format("{} ({})", text, others);
}

ConsoleSettings console_on_stderr(bool quiet, bool verbose)
{
    const char* terminal = std::getenv("TERM");
    const char* no_color = std::getenv("NO_COLOR");
    const bool can_redraw = terminal != nullptr && std::string_view(terminal) != "dumb";
    const bool live = !quiet && can_redraw && ::isatty(STDERR_FILENO) != 0;
    return {.stream = stderr,
            .live = live,
            .quiet = quiet,
            .verbose = verbose,
            .emphasis = live && (no_color == nullptr || *no_color == '\0')};
}

std::string bar_line(std::string_view name, double share, double seconds, std::size_t columns)
{
    constexpr double kTelling = 0.02; // the time left is estimated from this share on
    std::string line = fmt::format("{:<12} ", name);
    if (share > 0.0) {
        line +=
            fmt::format("{} {:>3.0f} %  ", bar_of(share, kBarCells), 100.0 * std::min(share, 1.0));
    }
    line += share < kTelling ? fmt::format("{:.0f} s", seconds)
                             : fmt::format("about {} left",
                                           time_text(seconds * (1.0 / std::min(share, 1.0) - 1.0)));
    // A line that fills the terminal's width would scroll it.
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
    if (stage_seconds() < settings_.bar_after_s) return;
    const std::string line =
        bar_line(stage_, share_.load(), stage_seconds(), columns_of(settings_.stream));
    std::fputs((kClearLine + line).c_str(), settings_.stream);
    std::fflush(settings_.stream);
    bar_is_drawn_ = true;
}

void ConsoleLog::print_line(std::string_view text)
{
    if (settings_.quiet) return;
    remove_bar();
    // Lines that cannot be written are dropped: a run does not fail because of its log.
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
    counts_[std::string(name)] = counts;
    const std::optional<std::string> words =
        settings_.verbose ? counts_text(counts) : stage_words(counts);
    if (words) {
        print_line(control_free(
            fmt::format("{:<12} {:<{}} {:>8.2f} s", name, *words, kTextColumns, stage_seconds())));
    }
    stage_.clear();
}

void ConsoleLog::note(std::string_view sentence)
{
    const std::lock_guard lock(mutex_);
    print_line(fmt::format("{} {}", emphasised("note:"), control_free(sentence)));
}

void ConsoleLog::conclude(std::string_view sentence)
{
    const std::lock_guard lock(mutex_);
    print_line(emphasised(sentence));
}

} // namespace vcarve::cli
