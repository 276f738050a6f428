#pragma once

#include "base/progress.h"
#include "run/work_folder.h"

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vcarve {

/// A message to a log: the end of a stage, or a note.
struct LogEvent {
    std::string text; ///< the stage's name, or the note
    bool is_stage = false;
    Counts counts; ///< of a stage
};

template <>
inline constexpr int kNumFields<LogEvent> = 3;

/// Forwards all messages to another log, and records ends of stages and notes.
class RememberingLog final : public Log {
  public:
    explicit RememberingLog(Log& shown) : shown_(shown) {}

    void stage_begins(std::string_view name) override { shown_.stage_begins(name); }
    void stage_progresses(double share) override { shown_.stage_progresses(share); }
    void stage_ends(std::string_view name, const Counts& counts) override;
    void note(std::string_view sentence) override;
    bool should_stop() const override { return shown_.should_stop(); }

    const std::vector<LogEvent>& events() const { return events_; }
    /// Forwards and records these messages.
    void replay(const std::vector<LogEvent>& events);

  private:
    Log& shown_;
    std::vector<LogEvent> events_;
};

/// Saves results of a run to a work folder, and loads them from it. Without a folder, computes
/// everything and saves nothing.
class Checkpoints {
  public:
    /// The stages of the run must use log() instead of `log`, so that their messages are recorded.
    /// If `folder` is not null, its begin() was called. All arguments must outlive the object.
    Checkpoints(WorkFolder* folder, Log& log) : folder_(folder), shown_(log), remembering_(log) {}

    Log& log() { return folder_ == nullptr ? shown_ : remembering_; }

    /// Loads `made` from an earlier run's checkpoint and replays its log messages. Without one,
    /// calls make(), which fills `made`, and saves it. An unusable file causes a note, and make()
    /// computes the same bytes again. Calls may be nested in make(); a usable outer checkpoint
    /// skips the inner ones. If a file cannot be written, such as on a full disk, a note is logged
    /// and the run continues in memory. Throws what make() throws, and Cancelled.
    template <typename Made, typename Make>
    void keep(std::string_view name, Made& made, const Make& make);

    /// Returns make(), or its saved result of an earlier run: a part of what the enclosing keep()
    /// makes. Thread-safe. keep() logs notes about unusable parts when make() ends, and removes all
    /// parts. Throws UsageError if a part cannot be written, because its caller relies on it.
    template <typename Make>
    auto piece(const StagePiece& piece, const Make& make) -> decltype(make());

  private:
    template <typename Made>
    bool is_taken(std::string_view name, Made& made);
    void report_resumed(std::string_view name, const std::vector<LogEvent>& told);
    void note_made_again(std::string_view sentence);
    void note_not_saved(std::string_view name, const UsageError& error);
    void report_unusable_pieces();

    WorkFolder* folder_;
    Log& shown_;
    RememberingLog remembering_;
    std::mutex mutex_;                  ///< guards unusable_
    std::vector<std::string> unusable_; ///< errors of parts
};

/// The counts of a stage that wrote or read a file.
Counts size_counts(std::string_view name, std::uint64_t bytes);

template <typename Made, typename Make>
void Checkpoints::keep(std::string_view name, Made& made, const Make& make)
{
    if (folder_ == nullptr) return make();
    if (is_taken(name, made)) return;
    const auto first_told = static_cast<std::ptrdiff_t>(remembering_.events().size());
    make();
    report_unusable_pieces();
    try {
        Stage stage(shown_, "keep");
        const std::vector<LogEvent> told(remembering_.events().begin() + first_told,
                                         remembering_.events().end());
        stage.end(size_counts(name, folder_->save(name, stage, told, std::as_const(made))));
        folder_->drop_all(fmt::format("{}-", name));
    } catch (const UsageError& error) {
        note_not_saved(name, error);
    }
}

template <typename Made>
bool Checkpoints::is_taken(std::string_view name, Made& made)
{
    if (!folder_->has(name)) return false;
    Made kept;
    std::vector<LogEvent> told;
    try {
        Stage stage(shown_, "resume");
        stage.end(size_counts(name, folder_->load(name, stage, told, kept)));
    } catch (const InputError& error) {
        note_made_again(error.what());
        folder_->drop(name);
        return false;
    }
    made = std::move(kept);
    report_resumed(name, told);
    return true;
}

template <typename Make>
auto Checkpoints::piece(const StagePiece& piece, const Make& make) -> decltype(make())
{
    if (folder_ == nullptr) return make();
    const std::string name = piece_name(piece);
    try {
        decltype(make()) kept;
        if (folder_->has(name)) {
            folder_->load(name, {}, kept);
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

} // namespace vcarve
