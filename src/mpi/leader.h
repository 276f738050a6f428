#pragma once

#include "cli/run_memory.h"
#include "mpi/session.h"

#include <atomic>
#include <functional>
#include <optional>
#include <string>

namespace vcarve::mpi {

/// Lets rank 0 give orders to the other ranks. While they work, a thread polls for replies 100
/// times per second and sleeps in between.
class Leader final : public cli::RunRanks {
  public:
    /// `session` must outlive it.
    explicit Leader(const Session& session) : session_(session) {}
    Leader(const Leader&) = delete;
    Leader& operator=(const Leader&) = delete;
    /// Orders the other ranks to end.
    ~Leader() override;

    std::size_t count() const override { return session_.rank().of; }
    void begin(const cli::JobOfRanks& job) override;
    void share(const std::string& task, const std::function<void()>& own) override;
    bool has_failed() const override { return has_failed_; }

  private:
    void report_all(const Order& order) const;
    std::optional<RankError> gather(const std::atomic<bool>& stops);

    const Session& session_;
    std::atomic<bool> has_failed_ = false; ///< whether another rank failed
};

} // namespace vcarve::mpi
