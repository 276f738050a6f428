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

/// Converts the size of a container to a count.
inline std::int64_t size_of(std::size_t count)
{
    return static_cast<std::int64_t>(count);
}

/// One stage of a run. Notifies the log of its begin and, if it succeeds, of its end.
class Stage {
  public:
    Stage(Log& log, std::string_view name) : log_(log), name_(name)
    {
        log_.stage_begins(name_);
        throw_if_stopped();
    }
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;

    /// Reports a share to the log, if it exceeds the last reported share by at least 0.001. Throws
    /// Cancelled if the log requests a stop.
    void progress(double share)
    {
        throw_if_stopped();
        // If the mutex is locked, another thread is reporting about the same share.
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock.owns_lock() || share < events_ + 0.001) return;
        events_ = std::min(share, 1.0);
        log_.stage_progresses(events_);
    }
    /// Ends the stage with its counts. Call it once, when the work is done.
    void end(const Counts& counts)
    {
        throw_if_stopped();
        if (events_ > 0.0 && events_ < 1.0) log_.stage_progresses(1.0);
        log_.stage_ends(name_, counts);
    }

  private:
    void throw_if_stopped() const
    {
        if (log_.should_stop()) throw Cancelled(name_);
    }

    Log& log_;
    std::string name_;
    std::mutex mutex_; ///< guards events_
    double events_ = 0.0;
};

/// The progress of a part of a stage, reported to the stage. Copies report to the same stage. A
/// default-constructed object reports nothing and never throws Cancelled.
class Progress {
  public:
    /// The number of small work items, some microseconds each, between two calls of report().
    static constexpr std::size_t kReportEvery = 256;

    Progress() = default;
    /// The progress of a whole stage.
    // NOLINTNEXTLINE(google-explicit-constructor): a stage is its own progress, from 0 to 1
    Progress(Stage& stage) : stage_(&stage) {}

    /// The progress of the part from share `from` to share `to`.
    Progress part(double from, double to) const
    {
        Progress result = *this;
        result.from_ = from_ + from * (to_ - from_);
        result.to_ = from_ + to * (to_ - from_);
        return result;
    }

    /// Reports the finished share, from 0 to 1. Throws Cancelled if the run should stop, so call it
    /// about ten times per second. Thread-safe.
    void report(double share) const
    {
        if (stage_ != nullptr) stage_->progress(from_ + share * (to_ - from_));
    }
    /// Reports `done` of `all` work items as finished; 1 if `all` is 0.
    void report(double done, double all) const { report(all > 0.0 ? done / all : 1.0); }

  private:
    Stage* stage_ = nullptr;
    double from_ = 0.0;
    double to_ = 1.0;
};

/// Counts work items finished by several threads, and reports their share of `all`.
class ProgressCount {
  public:
    ProgressCount(const Progress& progress, std::size_t all)
        : progress_(progress), all_(static_cast<double>(all))
    {
    }

    void add(std::size_t done)
    {
        const std::size_t before = done_.fetch_add(done, std::memory_order_relaxed);
        progress_.report(static_cast<double>(before + done), all_);
    }

  private:
    Progress progress_;
    double all_;
    std::atomic<std::size_t> done_ = 0;
};

} // namespace vcarve
