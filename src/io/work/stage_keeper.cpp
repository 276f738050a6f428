#include "io/work/stage_keeper.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vcarve {

namespace {

constexpr const char* kMadeAgain = "it is made again";

} // namespace

void RememberingLog::stage_ends(std::string_view name, const Counts& counts)
{
    told_.push_back({std::string(name), true, counts});
    shown_.stage_ends(name, counts);
}

void RememberingLog::note(std::string_view sentence)
{
    told_.push_back({std::string(sentence), false, {}});
    shown_.note(sentence);
}

void RememberingLog::tell_again(const std::vector<ToldEvent>& events)
{
    for (const ToldEvent& event : events) {
        if (event.is_stage) {
            stage_begins(event.text);
            stage_ends(event.text, event.counts);
        } else {
            note(event.text);
        }
    }
}

void StageKeeper::tell_taken(std::string_view name, const std::vector<ToldEvent>& told)
{
    std::vector<std::string> stages;
    for (const ToldEvent& event : told) {
        if (event.is_stage) stages.push_back(event.text);
    }
    shown_.note(fmt::format("what an earlier run made in the stages {} is taken from {}, so they "
                            "take no time now",
                            fmt::join(stages, ", "), (folder_->path() / name).string()));
    remembering_.tell_again(told);
}

void StageKeeper::note_unusable(const InputError& error)
{
    shown_.note(fmt::format("{}; {}", error.what(), kMadeAgain));
}

void StageKeeper::tell_unusable_pieces()
{
    const std::lock_guard lock(mutex_);
    for (const std::string& sentence : std::exchange(unusable_, {})) {
        shown_.note(fmt::format("{}; {}", sentence, kMadeAgain));
    }
}

} // namespace vcarve
