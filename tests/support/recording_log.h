#pragma once

#include "base/progress.h"

#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// Records all calls. After stop() it requests cancellation.
class RecordingLog : public Log {
  public:
    void stage_begins(std::string_view name) override
    {
        const std::lock_guard lock(mutex_);
        stage_ = name;
        shares_[stage_];
        if (on_stage) on_stage(stage_);
    }
    void stage_progresses(double share) override
    {
        const std::lock_guard lock(mutex_);
        shares_[stage_].push_back(share);
        if (on_share) on_share(stage_);
    }
    void stage_ends(std::string_view name, const Counts& /*counts*/) override
    {
        const std::lock_guard lock(mutex_);
        ended_.emplace_back(name);
    }
    void note(std::string_view sentence) override
    {
        const std::lock_guard lock(mutex_);
        notes_.emplace_back(sentence);
    }
    bool should_stop() const override { return stops_; }

    void stop() { stops_ = true; }

    /// The shares that each stage reported, in order. If a stage runs twice, they are appended.
    std::map<std::string, std::vector<double>> shares() const
    {
        const std::lock_guard lock(mutex_);
        return shares_;
    }
    std::vector<std::string> ended() const
    {
        const std::lock_guard lock(mutex_);
        return ended_;
    }

    std::vector<std::string> notes() const
    {
        const std::lock_guard lock(mutex_);
        return notes_;
    }

    std::function<void(const std::string&)> on_stage; ///< called when a stage begins
    std::function<void(const std::string&)> on_share; ///< called when a stage reports progress

  private:
    mutable std::mutex mutex_;
    std::string stage_;
    std::map<std::string, std::vector<double>> shares_;
    std::vector<std::string> ended_;
    std::vector<std::string> notes_;
    std::atomic<bool> stops_ = false;
};

} // namespace vcarve
