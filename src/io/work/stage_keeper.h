#pragma once

#include "base/log.h"
#include "io/work/ranks.h"
#include "io/work/work_folder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

/// What a log was told: the end of a stage, or a note.
struct ToldEvent {
    std::string text; ///< the stage's name, or the note
    bool is_stage = false;
    Counts counts; ///< of a stage
};

template <>
struct KeptFields<Counts::value_type> {
    static void visit(const auto& field, auto& count)
    {
        field(count.first);
        field(count.second);
    }
};

template <>
struct KeptFields<ToldEvent> {
    static void visit(const auto& field, auto& event)
    {
        field(event.text);
        field(event.is_stage);
        field(event.counts);
    }
};

/// Passes on what it is told, and remembers it.
class RememberingLog final : public Log {
  public:
    /// Also wants to stop where one of `ranks` has failed, if they are not null.
    explicit RememberingLog(Log& shown, const Ranks* ranks = nullptr) : shown_(shown), ranks_(ranks)
    {
    }

    void stage_begins(std::string_view name) override { shown_.stage_begins(name); }
    void stage_progresses(double share) override { shown_.stage_progresses(share); }
    void stage_ends(std::string_view name, const Counts& counts) override;
    void note(std::string_view sentence) override;
    bool wants_stop() const override
    {
        return shown_.wants_stop() || (ranks_ != nullptr && ranks_->has_failed());
    }

    const std::vector<ToldEvent>& told() const { return told_; }
    /// Tells all of it, now.
    void tell_again(const std::vector<ToldEvent>& events);

  private:
    Log& shown_;
    const Ranks* ranks_;
    std::vector<ToldEvent> told_;
};

/// What a stage counts that wrote or read the file of another.
Counts size_counts(std::string_view name, std::uint64_t bytes);

/// What a stage made that another rank has kept, or loaded: its large arrays are mapped, to be read
/// only, as WorkFolder::map() says. Throws InputError as that does.
template <typename Made>
void map_stage(const WorkFolder& folder, std::string_view name, Made& made)
{
    std::vector<ToldEvent> told;
    folder.map(name, told, made);
}

/// Where the results of a run's stages go and come from: a work folder, or none. Without a folder
/// every stage is made, and that is all.
class StageKeeper {
  public:
    /// Stages of the run have to tell log() instead of `log`, so that what they said can be said
    /// again. `folder`, where it is not null, has begun the job; `ranks`, where it is not null,
    /// have that folder in common. All of them must outlive it.
    StageKeeper(WorkFolder* folder, Log& log, Ranks* ranks = nullptr)
        : folder_(folder), ranks_(ranks), shown_(log), remembering_(log, ranks)
    {
    }

    Log& log() { return folder_ == nullptr ? shown_ : remembering_; }
    bool keeps() const { return folder_ != nullptr; }

    /// What make() returns, or returned in an earlier run; it is kept for later ones. What was told
    /// while it was made is told again then. A file that cannot be used, whatever the reason, is
    /// told of in a note, and the stage is made again: the bytes will be the same. Stages may be
    /// made within stages: of one that is there, those within are not asked for. Where a stage
    /// cannot be written, for the disk is full, a note says so and the run goes on with what it has
    /// in memory. Throws what make() throws, and Cancelled.
    template <typename Make>
    auto stage(std::string_view name, const Make& make) -> decltype(make());

    /// The same for a part of a stage, from many threads, to be called within make() of its stage.
    /// Parts are no stages of the log, and what is wrong with their files is told when the stage
    /// ends. They go when their stage is kept. Throws UsageError where one cannot be written, for
    /// who works in parts counts on them.
    template <typename Make>
    auto piece(const StagePiece& piece, const Make& make) -> decltype(make());

    /// The same of a part that share() has had made, or looked at, by some rank of this run: it is
    /// believed, and large arrays in scratch memory are mapped, to be read only.
    template <typename Make>
    auto shared_piece(const StagePiece& piece, const Make& make) -> decltype(make());

    /// How many processes work on the run.
    std::size_t num_ranks() const { return ranks_ == nullptr ? 1 : ranks_->count(); }

    /// Has the other ranks do their shares of a task, whose file has a name that begins so, and
    /// calls own() for the share of this one. False, and nothing is done, where there are no
    /// others, or `needed`, stages that they begin with, could not be kept. Throws as
    /// Ranks::share() does, and UsageError where the task cannot be written.
    template <typename Task, typename Own>
    bool share(std::string_view name, const Task& task, std::span<const std::string_view> needed,
               const Own& own);

  private:
    template <typename Make, typename Take>
    auto piece_taken_by(const Take& take, const StagePiece& piece, const Make& make)
        -> decltype(make());
    template <typename Made>
    std::optional<Made> taken(std::string_view name);
    template <typename Made>
    void keep(std::string_view name, const Made& made, std::size_t first_told);
    std::vector<ToldEvent> told_since(std::size_t first) const;
    void tell_taken(std::string_view name, const std::vector<ToldEvent>& told);
    void note_unusable(const InputError& error);
    void note_unkept(std::string_view name, const UsageError& error);
    void tell_unusable_pieces();
    std::string name_of_task(std::string_view name);
    void share_file(const std::string& task, const std::function<void()>& own);

    WorkFolder* folder_;
    Ranks* ranks_;
    Log& shown_;
    RememberingLog remembering_;
    int num_tasks_ = 0;
    std::mutex mutex_;                  ///< guards what follows
    std::vector<std::string> unusable_; ///< sentences about pieces
};

template <typename Make>
auto StageKeeper::stage(std::string_view name, const Make& make) -> decltype(make())
{
    if (folder_ == nullptr) return make();
    using Made = decltype(make());
    if (std::optional<Made> kept = taken<Made>(name)) return std::move(*kept);
    const std::size_t first_told = remembering_.told().size();
    Made made = make();
    tell_unusable_pieces();
    try {
        keep(name, made, first_told);
        folder_->drop_pieces(name);
    } catch (const UsageError& error) {
        note_unkept(name, error);
    }
    return made;
}

template <typename Make>
auto StageKeeper::piece(const StagePiece& piece, const Make& make) -> decltype(make())
{
    const auto load = [&](const std::string& name, auto& kept) { folder_->load(name, {}, kept); };
    return piece_taken_by(load, piece, make);
}

template <typename Make>
auto StageKeeper::shared_piece(const StagePiece& piece, const Make& make) -> decltype(make())
{
    const auto map = [&](const std::string& name, auto& kept) { folder_->map(name, kept); };
    return piece_taken_by(map, piece, make);
}

/// Calls take(name, kept) for a part that is there.
template <typename Make, typename Take>
auto StageKeeper::piece_taken_by(const Take& take, const StagePiece& piece, const Make& make)
    -> decltype(make())
{
    if (folder_ == nullptr) return make();
    const std::string name = piece_name(piece);
    try {
        decltype(make()) kept;
        if (folder_->has(name)) {
            take(name, kept);
            return kept;
        }
    } catch (const InputError& error) {
        const std::lock_guard lock(mutex_);
        unusable_.emplace_back(error.what());
    }
    auto made = make();
    folder_->save(name, {}, made);
    return made;
}

template <typename Task, typename Own>
bool StageKeeper::share(std::string_view name, const Task& task,
                        std::span<const std::string_view> needed, const Own& own)
{
    const auto is_there = [&](std::string_view stage) { return folder_->has(stage); };
    if (num_ranks() == 1 || folder_ == nullptr || !std::ranges::all_of(needed, is_there)) {
        return false;
    }
    const std::string file = name_of_task(name);
    folder_->save(file, {}, task);
    share_file(file, own);
    return true;
}

template <typename Made>
std::optional<Made> StageKeeper::taken(std::string_view name)
{
    if (!folder_->has(name)) return std::nullopt;
    std::optional<Made> made(std::in_place);
    std::vector<ToldEvent> told;
    try {
        Stage stage(shown_, "resume");
        const std::uint64_t bytes = folder_->load(name, stage, told, *made);
        stage.end(size_counts(name, bytes));
    } catch (const InputError& error) {
        note_unusable(error);
        folder_->drop(name); // other ranks are not to find it
        return std::nullopt;
    }
    tell_taken(name, told);
    return made;
}

template <typename Made>
void StageKeeper::keep(std::string_view name, const Made& made, std::size_t first_told)
{
    Stage stage(shown_, "keep");
    const std::uint64_t bytes = folder_->save(name, stage, told_since(first_told), made);
    stage.end(size_counts(name, bytes));
}

} // namespace vcarve
