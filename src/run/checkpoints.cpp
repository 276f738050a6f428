#include "run/checkpoints.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

namespace vcarve {

Counts size_counts(std::string_view name, std::uint64_t bytes)
{
    return {{fmt::format("MiB of {}", name), static_cast<std::int64_t>(bytes >> 20) + 1}};
}

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

void Checkpoints::tell_taken(std::string_view name, const std::vector<ToldEvent>& told)
{
    std::vector<std::string> stages;
    for (const ToldEvent& event : told) {
        if (event.is_stage) stages.push_back(event.text);
    }
    shown_.note(fmt::format("{} of the folder {} has what an earlier run made in {}", name,
                            folder_->path().string(), fmt::join(stages, ", ")));
    remembering_.tell_again(told);
}

void Checkpoints::note_unkept(std::string_view name, const UsageError& error)
{
    shown_.note(
        fmt::format("{}; the run goes on, but {} would have to be made again", error.what(), name));
}

void Checkpoints::note_made_again(std::string_view sentence)
{
    shown_.note(fmt::format("{}; it is made again", sentence));
}

/// No task has the name of another, also of another process: a rank may still see the file of one
/// that is over, on a network file system or of a job that was killed.
std::string Checkpoints::name_of_task(std::string_view name)
{
    return fmt::format("{}-{}-{}", name, ::getpid(), ++num_tasks_);
}

void Checkpoints::share_file(const std::string& task, const std::function<void()>& own)
{
    try {
        ranks_->share(task, own);
    } catch (...) {
        folder_->drop(task);
        throw;
    }
    folder_->drop(task);
}

void Checkpoints::tell_unusable_pieces()
{
    const std::lock_guard lock(mutex_);
    for (const std::string& sentence : std::exchange(unusable_, {})) {
        note_made_again(sentence);
    }
}

} // namespace vcarve
