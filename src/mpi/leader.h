#pragma once

#include "cli/run_memory.h"
#include "mpi/session.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace vcarve::mpi {

/// The other ranks, for rank 0, which tells them what to do. While they work a thread looks a
/// hundred times a second whether one is done or has failed, and sleeps in between.
class Leader final : public cli::RunRanks {
  public:
    /// `session` must outlive it. Made by all ranks at the same time, see Session::processes().
    Leader(const Session& session, const cli::Processes& processes)
        : session_(session), processes_(processes)
    {
    }
    Leader(const Leader&) = delete;
    Leader& operator=(const Leader&) = delete;
    /// Tells the others that the program ends.
    ~Leader() override;

    cli::Processes processes() const override { return processes_; }
    void begin(const cli::JobOfRanks& job) override;
    void share(const std::string& task, const std::function<void()>& own) override;
    bool has_failed() const override { return has_failed_; }

  private:
    void tell_all(const Order& order) const;
    std::optional<RankError> gather(const std::atomic<bool>& stops);

    const Session& session_;
    cli::Processes processes_;
    std::atomic<bool> has_failed_ = false; ///< another rank
};

} // namespace vcarve::mpi
