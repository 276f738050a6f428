#include "cli/stage_lines.h"

#include "base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace vcarve::cli {

namespace {

constexpr std::size_t kTextColumns = 55; ///< beside the name and the seconds, of 80

/// How a stage is called, and what is said of it: "{points} of {of} points", where a name in braces
/// stands for that count, and {name/1000} for thousandths of a unit. What follows after a bar is
/// said where its first count is not 0, and there is room. A stage without a text is not shown.
struct Wording {
    std::string_view stage;
    std::string_view name;
    std::string_view text;
};

constexpr Wording kWordings[] = {
    {"read", "read", "{points} points, {views} views, {sights} rays"},
    {"digest", "check", "{files} input files"},
    {"memory", "memory", "{MiB expected} MiB expected"},
    {"thin", "merge", "{of} points merged to {points}"},
    {"denoise", "denoise",
     "{points moved} points moved within their error| ({thousandths of a pixel of noise/1000} px)"},
    {"filter", "filter",
     "{points} of {of} points kept|, {duplicate} duplicate|, {few views} of few views"
     "|, {high error} of large error|, {low angle} of small angle|, {stray} stray"
     "|, {non-finite} not finite"},
    {"crop", "crop",
     "{points} of {of} points in the region|, {outside but seen through it} seen through it"},
    {"fill", "fill", "{points added} points added on planes"},
    {"triangulate", "triangulate", "{cells} cells"},
    {"sights", "rays", "{sights} rays from points to cameras|, {inferred} more likely"},
    {"virtual", "viewpoints", "{views} more viewpoints, {sights} rays"},
    {"carve", "carve", "{inside} of {of} cells are solid"},
    {"cut", "cut", "{inside} of {of} cells are solid"},
    {"surface", "surface",
     "{faces} faces seen by cameras|, {unseen} unseen dropped"
     "|, {closing without support} unsupported dropped"},
    {"clean", "clean",
     "{faces} faces|, holes filled: {holes filled}|, small pieces dropped: {components dropped}"},
    {"open", "open", ""},
    {"settle", "denoise",
     "{vertices moved} vertices moved within their error"
     "| ({thousandths of a pixel of noise/1000} px)"},
    {"guard", "guard", ""},
    {"smooth", "smooth", "{vertices moved} of {of} vertices moved"},
    {"simplify", "simplify", "{of} faces merged to {faces}"},
    {"orient", "orient", ""},
    {"photos", "photos", "{seen} of {faces} faces shown by {photographs} photographs"},
    {"colors", "colours", "{vertices} vertices coloured|, {outliers} views of passers-by left out"},
    {"texture", "texture", "{charts} charts on {pages} pages"},
    {"check", "check",
     "{open edges} open edges|, {self-intersections} faces through others"
     "|, {sights from behind} rays from behind"},
    {"write", "write", ""},
};

/// A text with its counts filled in; nothing where one of them is missing.
std::optional<std::string> filled_in(std::string_view text, const Counts& counts)
{
    std::string filled;
    while (!text.empty()) {
        const std::size_t open = std::min(text.find('{'), text.size());
        filled += text.substr(0, open);
        text.remove_prefix(open);
        if (text.empty()) break;
        const std::size_t close = text.find('}');
        std::string_view name = text.substr(1, close - 1);
        constexpr std::string_view kThousandths = "/1000";
        const bool thousandths = name.ends_with(kThousandths);
        if (thousandths) name.remove_suffix(kThousandths.size());
        const auto count = std::ranges::find(counts, name, &Counts::value_type::first);
        if (count == counts.end()) return std::nullopt;
        filled += thousandths ? fmt::format("{:.2f}", static_cast<double>(count->second) / 1000.0)
                              : grouped_digits(count->second);
        text.remove_prefix(close + 1);
    }
    return filled;
}

/// Whether what is said besides is worth it: its first count, where it has one, is not 0.
bool is_worth_saying(std::string_view text, const Counts& counts)
{
    const std::size_t brace = text.find('{');
    if (brace == std::string_view::npos) return true;
    const std::size_t end = text.find_first_of("/}", brace);
    const std::string_view name = text.substr(brace + 1, end - brace - 1);
    const auto count = std::ranges::find(counts, name, &Counts::value_type::first);
    return count != counts.end() && count->second != 0;
}

std::optional<std::string> text_of(std::string_view wording, const Counts& counts)
{
    std::size_t end = std::min(wording.find('|'), wording.size());
    std::optional<std::string> text = filled_in(wording.substr(0, end), counts);
    while (text && end < wording.size()) {
        wording.remove_prefix(end + 1);
        end = std::min(wording.find('|'), wording.size());
        const std::string_view besides = wording.substr(0, end);
        if (!is_worth_saying(besides, counts)) continue;
        const std::string more = filled_in(besides, counts).value_or("");
        if (text->size() + more.size() <= kTextColumns) *text += more;
    }
    return text;
}

} // namespace

StageWords stage_words(std::string_view stage, const Counts& counts)
{
    const auto* const wording = std::ranges::find(kWordings, stage, &Wording::stage);
    if (wording == std::ranges::end(kWordings)) return {std::string(stage), counts_text(counts)};
    const bool is_shown = !wording->text.empty();
    const auto text = is_shown ? text_of(wording->text, counts) : std::nullopt;
    return {std::string(wording->name), text.value_or(counts_text(counts)), is_shown};
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

std::string stage_line(const StageWords& words, double seconds)
{
    return fmt::format("{:<12} {:<{}} {:>8.2f} s", words.name, words.text, kTextColumns, seconds);
}

} // namespace vcarve::cli
