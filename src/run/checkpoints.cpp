#include "run/checkpoints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vcarve {

Counts size_counts(std::string_view name, std::uint64_t bytes)
{
    return {{fmt::format("MiB of {}", name), static_cast<std::int64_t>(bytes >> 20) + 1}};
}

void RememberingLog::stage_ends(std::string_view name, const Counts& counts)
{
    events_.push_back({std::string(name), true, counts});
    shown_.stage_ends(name, counts);
}

void RememberingLog::note(std::string_view sentence)
{
    events_.push_back({std::string(sentence), false, {}});
    shown_.note(sentence);
}

void RememberingLog::replay(const std::vector<LogEvent>& events)
{
    for (const LogEvent& event : events) {
        if (event.is_stage) {
            stage_begins(event.text);
            stage_ends(event.text, event.counts);
        } else {
            note(event.text);
        }
    }
}

void Checkpoints::report_resumed(std::string_view name, const std::vector<LogEvent>& told)
{
    std::vector<std::string> stages;
    for (const LogEvent& event : told) {
        if (event.is_stage) stages.push_back(event.text);
    }
    shown_.note(fmt::format("checkpoint {} in the folder {} replaces the stages {}", name,
                            folder_->path().string(), fmt::join(stages, ", ")));
    remembering_.replay(told);
}

void Checkpoints::note_not_saved(std::string_view name, const UsageError& error)
{
    shown_.note(
        fmt::format("{}; the run continues without a checkpoint of {}", error.what(), name));
}

void Checkpoints::note_made_again(std::string_view sentence)
{
    shown_.note(fmt::format("{}; it is computed again", sentence));
}

void Checkpoints::report_unusable_pieces()
{
    const std::lock_guard lock(mutex_);
    for (const std::string& sentence : std::exchange(unusable_, {})) {
        note_made_again(sentence);
    }
}

} // namespace vcarve
