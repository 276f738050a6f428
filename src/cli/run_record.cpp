#include "cli/run_record.h"

#include "base/validate.h"
#include "base/version.h"

#include <algorithm>
#include <cmath>

namespace vcarve::cli {

namespace {

Json counts_json(const Counts& counts)
{
    Json json = Json::object();
    std::string before;
    for (const auto& [name, count] : counts) {
        json[name == "of" ? "of " + before : name] = count;
        before = name;
    }
    return json;
}

/// One word as a shell takes it.
std::string quoted(const std::string& word)
{
    constexpr const char* kPlain =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_=./,:+@%";
    if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) return word;
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

/// To the microsecond, which is more than such a figure is good for.
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

} // namespace

StageRecorder::StageRecorder(Log& shown) : shown_(shown), run_began_(process_usage()) {}

void StageRecorder::stage_begins(std::string_view name)
{
    // What was held between two stages counts for the whole run, though for no stage.
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

void OptionRecorder::number(double& value, const OptionInfo& info)
{
    // JSON has no infinity.
    if (std::isfinite(value)) {
        json_[info.name] = value;
    } else {
        json_[info.name] = value > 0.0 ? "inf" : "-inf";
    }
}

void OptionRecorder::count(int& value, const OptionInfo& info)
{
    json_[info.name] = value;
    if (means_word(value, info)) json_[info.name] = info.word;
}

void OptionRecorder::bytes(std::int64_t& value, const OptionInfo& info)
{
    json_[info.name] = value;
    if (means_word(static_cast<double>(value), info)) json_[info.name] = info.word;
}

void OptionRecorder::word_or_vector(WordOrVector& value, std::span<const char* const> words,
                                    const OptionInfo& info)
{
    if (value.word == WordOrVector::kNoWord) {
        json_[info.name] = {value.vector.x(), value.vector.y(), value.vector.z()};
    } else {
        json_[info.name] = words[static_cast<std::size_t>(value.word)];
    }
}

void OptionRecorder::region(RegionChoice& value, const OptionInfo& info)
{
    if (value.kind == RegionChoice::Kind::box) {
        json_[info.name] = {value.low.x(),  value.low.y(),  value.low.z(),
                            value.high.x(), value.high.y(), value.high.z()};
    } else {
        json_[info.name] = region_text(value);
    }
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
