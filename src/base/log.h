#pragma once

#include "vcarve/error.h"
#include "vcarve/log.h"

#include <algorithm>
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

} // namespace vcarve
