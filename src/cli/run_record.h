#pragma once

#include "base/process_usage.h"
#include "base/progress.h"
#include "options/option.h"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <span>
#include <string>

namespace vcarve::cli {

/// JSON with keys in insertion order, so that people can read a record from top to bottom.
using Json = nlohmann::ordered_json;

/// Forwards to another log, and records seconds, CPU seconds, peak memory and counts of each stage.
/// Resets the process's peak memory at each stage, so `time -v` shows the peak of the last stage.
class StageRecorder final : public Log {
  public:
    explicit StageRecorder(Log& shown);

    void stage_begins(std::string_view name) override;
    void stage_progresses(double share) override { shown_.stage_progresses(share); }
    void stage_ends(std::string_view name, const Counts& counts) override;
    void note(std::string_view sentence) override;
    bool should_stop() const override { return shown_.should_stop(); }

    /// {"stages": [{"name", "seconds", "cpu_seconds", "peak_memory_bytes", "counts"}], "notes": [],
    /// "total": {"seconds", "cpu_seconds", "peak_memory_bytes"}, "peak_memory_is_per_stage"}.
    /// The keys of counts are those of base/stage_counts.h; the total of KEY is "of KEY".
    Json json() const;

  private:
    Log& shown_;
    ProcessUsage run_began_;
    ProcessUsage stage_began_;
    bool peak_is_per_stage_ = true;
    std::int64_t largest_peak_ = 0;
    Json stages_ = Json::array();
    Json notes_ = Json::array();
};

/// Every option with its value: {"max-hole": 12, "method": "cut"}.
Json options_json(const OptionList& options);

/// The program's name, version and build, and those of its libraries.
Json program_json();

/// JSON as text for a file. Bytes that are not UTF-8 (in paths) are replaced.
std::string json_text(const Json& json);

/// A command line, quoted for a shell.
std::string command_text(std::string command, std::span<const std::string> words);

} // namespace vcarve::cli
