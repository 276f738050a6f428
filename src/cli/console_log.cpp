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

/// The text of a stage: "{points} of {of} points", with names of counts in braces, and
/// {name/1000} for thousandths. Parts after a bar are optional: they are shown if none of their
/// counts is 0 and there is room. A stage with an empty text is not shown.
struct Wording {
    std::string_view stage;
    std::string_view text;
};

constexpr Wording kWordings[] = {
    {"read", "{points} points, {views} views, {rays} rays"},
    {"digest", "{files} input files"},
    {"memory", "{MiB expected} MiB expected"},
    {"undistort", "{photographs} photographs undistorted"},
    {"depth", "{depth maps} depth maps"},
    {"fuse", "{points} points fused"},
    {"merge", "{of} points merged to {points}"},
    {"denoise",
     "{points moved} points moved within their error| ({thousandths of a pixel of noise/1000} px)"},
    {"filter", "{points} of {of} points kept|, {duplicate} duplicate|, {few views} few views"
               "|, {high error} large error|, {low angle} small angle|, {stray} stray"
               "|, {non-finite} not finite"},
    {"crop",
     "{points} of {of} points in the region|, {outside but seen through it} seen through it"},
    {"fill", "{points added} points added on planes"},
    {"triangulate", "{cells} cells"},
    {"rays", "{rays} rays from points to cameras| ({inferred} inferred)"},
    {"viewpoints", "{views} viewpoints added, {rays} rays"},
    {"carve", "{inside} of {of} cells are solid"},
    {"cut", "{inside} of {of} cells are solid"},
    {"surface", "{faces} visible faces|, {unseen} unseen dropped"
                "|, {unsupported} unsupported dropped"},
    {"clean",
     "{faces} faces|, holes filled: {holes filled}|, components dropped: {components dropped}"},
    {"open", ""},
    {"adjust", "{vertices moved} vertices moved within their error"
               "| ({thousandths of a pixel of noise/1000} px)"},
    {"guard", ""},
    {"smooth", "{vertices moved} of {of} vertices moved"},
    {"decimate", "{of} faces merged to {faces}"},
    {"simplify", "{of} faces merged to {faces}"},
    {"orient", ""},
    {"masks", "{faces} of {of} faces outside the masks"},
    {"photos", "{seen} of {faces} faces shown by {photographs} photographs"},
    {"colors", "{vertices} vertices colored|, {outliers} occluded views ignored"},
    {"texture", "{charts} charts on {pages} pages"},
    {"check", "{open edges} boundary edges|, {self-intersections} intersecting faces"
              "|, {rays from behind} rays from behind"},
    {"write", ""},
};

/// Fills counts into a part of a text. Returns nothing if a count is missing, or 0 in an optional
/// part.
std::optional<std::string> filled_in(std::string_view part, const Counts& counts, bool is_optional)
{
    constexpr std::string_view kThousandths = "/1000";
    std::string filled;
    for (std::size_t open = 0; (open = part.find('{')) != std::string_view::npos;) {
        filled += part.substr(0, open);
        const std::size_t close = part.find('}');
        std::string_view name = part.substr(open + 1, close - open - 1);
        const bool thousandths = name.ends_with(kThousandths);
        if (thousandths) name.remove_suffix(kThousandths.size());
        const auto count = std::ranges::find(counts, name, &Counts::value_type::first);
        if (count == counts.end() || (is_optional && count->second == 0)) return std::nullopt;
        filled += thousandths ? fmt::format("{:.2f}", static_cast<double>(count->second) / 1000.0)
                              : grouped_digits(count->second);
        part.remove_prefix(close + 1);
        const std::string_view nouns =
            part.substr(0, std::min(part.find_first_of(" ,", 1), part.size()));
        if (count->second == 1 && nouns.starts_with(' ') && nouns.ends_with('s')) {
            filled.pop_back();
            filled += counted(1, nouns.substr(1));
            part.remove_prefix(nouns.size());
        }
    }
    return filled.append(part);
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

StageWords stage_words(std::string_view stage, const Counts& counts)
{
    const auto* const wording = std::ranges::find(kWordings, stage, &Wording::stage);
    if (wording == std::ranges::end(kWordings)) return {counts_text(counts)};
    StageWords words = {"", !wording->text.empty()};
    for (std::string_view text = wording->text; !text.empty();) {
        const std::size_t bar = std::min(text.find('|'), text.size());
        const bool is_optional = !words.text.empty();
        const auto part = filled_in(text.substr(0, bar), counts, is_optional);
        if (!part && !is_optional) {
            words.text = counts_text(counts);
            break;
        }
        if (part && words.text.size() + part->size() <= kTextColumns) words.text += *part;
        text.remove_prefix(std::min(bar + 1, text.size()));
    }
    return words;
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
    const StageWords words =
        settings_.verbose ? StageWords{counts_text(counts)} : stage_words(name, counts);
    if (words.is_shown) {
        print_line(control_free(fmt::format("{:<12} {:<{}} {:>8.2f} s", name, words.text,
                                            kTextColumns, stage_seconds())));
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
