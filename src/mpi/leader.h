#pragma once

#include "cli/run_ranks.h"
#include "mpi/session.h"

namespace vcarve::mpi {

/// The other ranks, for rank 0, which tells them what to do. While they work it looks a hundred
/// times a second whether they are done, and leaves its core to others in between.
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
    void begin(const Digest& job, const cli::RankMemory& memory) override;
    void share(const std::string& task, const std::function<void()>& own) override;

  private:
    void tell_all(const Order& order) const;
    void wait_for_all();

    const Session& session_;
    cli::Processes processes_;
};

} // namespace vcarve::mpi
