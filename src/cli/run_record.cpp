#include "cli/run_record.h"

#include "base/version.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace vcarve::cli {

namespace {

Json counts_json(const Counts& counts)
{
    Json json = Json::object();
    for_each_number(counts, [&](const std::string& name, std::int64_t n) { json[name] = n; });
    return json;
}

/// Quotes a word for a shell if necessary.
std::string quoted(const std::string& word)
{
    constexpr const char* kUnquoted =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_=./,:+@%";
    if (!word.empty() && word.find_first_not_of(kUnquoted) == std::string::npos) return word;
    std::string text = "'";
    for (const char letter : word) {
        if (letter == '\'') {
            text += R"('\'')";
        } else {
            text += letter;
        }
    }
    text += '\'';
    return text;
}

/// Rounds to microseconds, below the precision of such measurements.
double rounded(double seconds)
{
    return std::round(seconds * 1e6) / 1e6;
}

Json usage_json(const ProcessUsage& began, std::int64_t peak)
{
    const ProcessUsage now = process_usage();
    return {{"seconds", rounded(now.seconds - began.seconds)},
            {"cpu_seconds", rounded(now.cpu_seconds - began.cpu_seconds)},
            {"peak_memory_bytes", peak}};
}

/// Numbers, flags, vectors and boxes become JSON values. Words, numbers that are not finite, and
/// other values become text as typed.
Json value_json(const Option& option)
{
    const std::string text = value_text(option);
    const bool is_word = std::ranges::count(option.info.words, text) != 0;
    if (is_word) return text;
    if (const auto* flag = std::get_if<bool*>(&option.value)) return **flag;
    if (const auto* count = std::get_if<int*>(&option.value)) return **count;
    if (const auto* bytes = std::get_if<std::int64_t*>(&option.value)) return **bytes;
    if (const auto* vector = std::get_if<WordOrVector*>(&option.value)) {
        return {(*vector)->vector.x(), (*vector)->vector.y(), (*vector)->vector.z()};
    }
    if (const auto* region = std::get_if<RegionChoice*>(&option.value);
        region != nullptr && (*region)->kind == RegionChoice::Kind::box) {
        const auto& [low, high] = std::pair((*region)->low, (*region)->high);
        return {low.x(), low.y(), low.z(), high.x(), high.y(), high.z()};
    }
    const auto* number = std::get_if<double*>(&option.value);
    if (number != nullptr && std::isfinite(**number)) return **number;
    return text;
}

} // namespace

StageRecorder::StageRecorder(Log& shown) : shown_(shown), run_began_(process_usage()) {}

void StageRecorder::stage_begins(std::string_view name)
{
    // Memory held between two stages counts for the whole run, but for no stage.
    largest_peak_ = std::max(largest_peak_, peak_memory_bytes());
    peak_is_per_stage_ = reset_peak_memory() && peak_is_per_stage_;
    stage_began_ = process_usage();
    shown_.stage_begins(name);
}

void StageRecorder::stage_ends(std::string_view name, const Counts& counts)
{
    const std::int64_t peak = peak_memory_bytes();
    largest_peak_ = std::max(largest_peak_, peak);
    Json stage = {{"name", name}};
    stage.update(usage_json(stage_began_, peak));
    stage["counts"] = counts_json(counts);
    stages_.push_back(stage);
    shown_.stage_ends(name, counts);
}

void StageRecorder::note(std::string_view sentence)
{
    notes_.push_back(sentence);
    shown_.note(sentence);
}

Json StageRecorder::json() const
{
    const std::int64_t peak = std::max(largest_peak_, peak_memory_bytes());
    return {{"stages", stages_},
            {"notes", notes_},
            {"total", usage_json(run_began_, peak)},
            {"peak_memory_is_per_stage", peak_is_per_stage_}};
}

Json options_json(const OptionList& options)
{
    Json json = Json::object();
    for (const Option& option : options) {
        json[option.info.name] = value_json(option);
    }
    return json;
}

Json program_json()
{
    const Versions build = versions();
    return {{"name", "colmap-vcarve"},    {"version", build.program},   {"git", build.git},
            {"build", build.build_type},  {"compiler", build.compiler}, {"CGAL", build.cgal},
            {"OpenMesh", build.openmesh}, {"Eigen", build.eigen},       {"oneTBB", build.tbb}};
}

std::string json_text(const Json& json)
{
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string command_text(std::string command, std::span<const std::string> words)
{
    for (const std::string& word : words) {
        command += ' ';
        command += quoted(word);
    }
    return command;
}

} // namespace vcarve::cli
