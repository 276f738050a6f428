#pragma once

#include "vcarve/error.h"
#include "vcarve/log.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>

namespace vcarve {

/// The size of a container, as a count.
inline std::int64_t size_of(std::size_t count)
{
    return static_cast<std::int64_t>(count);
}

/// One stage of a run: tells the log when it begins and, unless it failed, when it ends.
class Stage {
  public:
    Stage(Log& log, std::string_view name) : log_(log), name_(name)
    {
        log_.stage_begins(name_);
        stop_where_wanted();
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Tells the log this share, where it is larger by a thousandth than the one told before.
    /// Throws Cancelled where the log wants the run stopped.
    void progress(double share)
    {
        stop_where_wanted();
        // Another thread tells about the same just now.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock() || share < told_ + 0.001) return;
        told_ = std::min(share, 1.0);
        log_.stage_progresses(told_);
    }
    /// Ends the stage with what it counted. Call it once, when the work is done.
    void end(const Counts& counts)
    {
        stop_where_wanted();
        if (told_ > 0.0 && told_ < 1.0) log_.stage_progresses(1.0);
        log_.stage_ends(name_, counts);
    }

  private:
    void stop_where_wanted() const
    {
        if (log_.wants_stop()) throw Cancelled(name_);
    }

    Log& log_;
    std::string name_;
    std::mutex mutex_; ///< guards told_
    double told_ = 0.0;
};

/// How far a piece of work is, told to the stage it is a part of. A copy tells the same stage. One
/// made of nothing tells nobody and never stops.
class Progress {
  public:
    /// How many small things, some microseconds each, are done between one call of tell() and the
    /// next.
    static constexpr std::size_t kToldEvery = 256;

    Progress() = default;
    /// All of a stage.
    // NOLINTNEXTLINE(google-explicit-constructor): a stage is its own progress, from 0 to 1
    Progress(Stage& stage) : stage_(&stage) {}

    /// The piece from share `from` to share `to` of this one.
    Progress part(double from, double to) const
    {
        Progress result = *this;
        result.from_ = from_ + from * (to_ - from_);
        result.to_ = from_ + to * (to_ - from_);
        return result;
    }

    /// Tells that this share is done, 0 to 1. Throws Cancelled where the run is to stop, so it must
    /// be called some ten times a second. From any thread.
    void tell(double share) const
    {
        if (stage_ != nullptr) stage_->progress(from_ + share * (to_ - from_));
    }
    /// The same for so many of all.
    void tell(double done, double all) const { tell(all > 0.0 ? done / all : 1.0); }

  private:
    Stage* stage_ = nullptr;
    double from_ = 0.0;
    double to_ = 1.0;
};

/// Counts what many threads have done of a known number of things.
class ProgressCount {
  public:
    ProgressCount(const Progress& progress, std::size_t all)
        : progress_(progress), all_(static_cast<double>(all))
    {
    }

    void add(std::size_t done)
    {
        const std::size_t before = done_.fetch_add(done, std::memory_order_relaxed);
        progress_.tell(static_cast<double>(before + done), all_);
    }

  private:
    Progress progress_;
    double all_;
    std::atomic<std::size_t> done_ = 0;
};

} // namespace vcarve
