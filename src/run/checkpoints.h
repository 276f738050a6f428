#pragma once

#include "base/progress.h"
#include "run/ranks.h"
#include "run/work_folder.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
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
inline constexpr int kNumFields<ToldEvent> = 3;

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

/// What was kept of a run by another rank, or was loaded: its large arrays are mapped, to be read
/// only, as WorkFolder::map() says. Throws InputError as that does.
template <typename Made>
void map_kept(const WorkFolder& folder, std::string_view name, Made& made)
{
    std::vector<ToldEvent> told;
    folder.map(name, told, made);
}

/// Where what a run makes is kept and taken from: a work folder, or nowhere. Without a folder all
/// is made, and that is all.
class Checkpoints {
  public:
    /// The stages of the run have to tell log() instead of `log`, so that what they said can be
    /// said again. `folder`, where it is not null, has begun the job; `ranks`, where it is not
    /// null, have that folder in common. All of them must outlive it.
    Checkpoints(WorkFolder* folder, Log& log, Ranks* ranks = nullptr)
        : folder_(folder), ranks_(ranks), shown_(log), remembering_(log, ranks)
    {
    }

    Log& log() { return folder_ == nullptr ? shown_ : remembering_; }

    /// Calls make(), which fills `made`, and keeps that for later runs; or takes what an earlier
    /// run kept, and tells again what was told while it was made. A file that cannot be used,
    /// whatever the reason, is told of in a note, and all is made again: the bytes will be the
    /// same. It may be called within make(); of what is there, that within is not asked for. Where
    /// a file cannot be written, for the disk is full, a note says so and the run goes on with what
    /// it has in memory. Throws what make() throws, and Cancelled.
    template <typename Made, typename Make>
    void keep(std::string_view name, Made& made, const Make& make);

    /// What make() returns, or returned in an earlier run: a part of what a keep() around it makes,
    /// from many threads. What is wrong with its file is told when that ends, and then parts go.
    /// Throws UsageError where one cannot be written, for who works in parts counts on them.
    template <typename Make>
    auto piece(const StagePiece& piece, const Make& make) -> decltype(make())
    {
        return piece_taken_by(
            [&](const std::string& name, auto& kept) { folder_->load(name, {}, kept); }, piece,
            make);
    }
    /// The same of a part that share() has had made, or looked at, by some rank of this run: it is
    /// believed, and large arrays in scratch memory are mapped, to be read only.
    template <typename Make>
    auto shared_piece(const StagePiece& piece, const Make& make) -> decltype(make())
    {
        return piece_taken_by(
            [&](const std::string& name, auto& kept) { folder_->map(name, kept); }, piece, make);
    }

    /// How many processes work on the run.
    std::size_t num_ranks() const { return ranks_ == nullptr ? 1 : ranks_->count(); }

    /// Has the other ranks do their shares of a task, whose file has a name that begins so, and
    /// calls own() for the share of this one. False, and nothing is done, where there are no
    /// others, or `needed`, which they begin with, could not be kept. Throws as Ranks::share()
    /// does, and UsageError where the task cannot be written.
    template <typename Task, typename Own>
    bool share(std::string_view name, const Task& task, std::span<const std::string_view> needed,
               const Own& own);

  private:
    template <typename Make, typename Take>
    auto piece_taken_by(const Take& take, const StagePiece& piece, const Make& make)
        -> decltype(make());
    template <typename Made>
    bool is_taken(std::string_view name, Made& made);
    void tell_taken(std::string_view name, const std::vector<ToldEvent>& told);
    void note_made_again(std::string_view sentence);
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

/// What a stage counts that wrote or read a file.
Counts size_counts(std::string_view name, std::uint64_t bytes);

template <typename Made, typename Make>
void Checkpoints::keep(std::string_view name, Made& made, const Make& make)
{
    if (folder_ == nullptr) return make();
    if (is_taken(name, made)) return;
    const auto first_told = static_cast<std::ptrdiff_t>(remembering_.told().size());
    make();
    tell_unusable_pieces();
    try {
        Stage stage(shown_, "keep");
        const std::vector<ToldEvent> told(remembering_.told().begin() + first_told,
                                          remembering_.told().end());
        stage.end(size_counts(name, folder_->save(name, stage, told, std::as_const(made))));
        folder_->drop_pieces(name);
    } catch (const UsageError& error) {
        note_unkept(name, error);
    }
}

template <typename Made>
bool Checkpoints::is_taken(std::string_view name, Made& made)
{
    if (!folder_->has(name)) return false;
    Made kept;
    std::vector<ToldEvent> told;
    try {
        Stage stage(shown_, "resume");
        stage.end(size_counts(name, folder_->load(name, stage, told, kept)));
    } catch (const InputError& error) {
        note_made_again(error.what());
        folder_->drop(name); // other ranks are not to find it
        return false;
    }
    made = std::move(kept);
    tell_taken(name, told);
    return true;
}

/// Calls take(name, kept) for a part that is there.
template <typename Make, typename Take>
auto Checkpoints::piece_taken_by(const Take& take, const StagePiece& piece, const Make& make)
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
bool Checkpoints::share(std::string_view name, const Task& task,
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

} // namespace vcarve
