#include "mpi/follower.h"

#include "base/scratch_memory.h"
#include "base/threads.h"
#include "cli/exit_code.h"
#include "cli/run_memory.h"
#include "pipeline/rank_shares.h"
#include "run/work_folder.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
#include <limits>
#include <memory>
#include <optional>
#include <thread>

namespace vcarve::mpi {

namespace {

constexpr std::chrono::milliseconds kPause(10);

/// Shows nothing, and can cancel the running task.
class QuietLog final : public Log {
  public:
    bool should_stop() const override { return wants_stop_; }
    void stop() { wants_stop_ = true; }

  private:
    std::atomic<bool> wants_stop_ = false;
};

/// The state of a run on a rank.
class JoinedRun {
  public:
    JoinedRun(const cli::MeshArguments& arguments, const Order& begun, const Session& session,
              const cli::Processes& processes)
        : in_files_(begun.in_files != 0),
          allowed_(cli::allowed_memory(arguments.options.memory, processes.here)),
          folder_(arguments.work, begun.job),
          shares_(folder_, arguments.options, session.rank())
    {
        if (begun.options != cli::digest_of_options(arguments.options)) {
            throw UsageError("it was started with other options or another program than "
                             "rank 0");
        }
    }

    void work(const char* task, Log& log)
    {
        {
            Stage stage(log, "wait");
            folder_.wait_for(task, stage);
        }
        constexpr std::int64_t kNoLimit = std::numeric_limits<std::int64_t>::max();
        if (!scratch_ && in_files_) {
            scratch_.emplace(folder_.path(), allowed_.value_or(kNoLimit));
        } else if (!scratch_) {
            scratch_.emplace();
        }
        shares_.work(task, log);
    }

  private:
    bool in_files_;
    std::optional<std::int64_t> allowed_;  ///< memory limit in bytes
    std::optional<ScratchMemory> scratch_; ///< destroyed last
    WorkFolder folder_;
    RankShares shares_;
};

/// Does a share on another thread, so that this thread can receive orders to stop.
Reply done(const Session& session, const std::function<void(Log&)>& work)
{
    QuietLog log;
    cli::Ending ending;
    bool was_stopped = false;
    std::atomic<bool> is_done = false;
    std::thread worker([&] {
        ending = cli::ending_of([&] {
            try {
                work(log);
            } catch (const Cancelled&) {
                was_stopped = true;
            } catch (const ScratchError& error) {
                throw UsageError(error.what());
            }
        });
        is_done = true;
    });
    while (!is_done) {
        const std::optional<Order> next = session.order();
        if (next && next->kind == Order::Kind::stop) log.stop();
        std::this_thread::sleep_for(kPause);
    }
    worker.join();
    Reply reply = {.exit_code = ending.exit_code, .was_stopped = was_stopped ? 1 : 0};
    if (ending.exit_code != 0) {
        set_text(reply.sentence,
                 fmt::format("{} failed: {}", session.name(),
                             ending.sentence.empty() ? "out of memory" : ending.sentence));
    }
    return reply;
}

} // namespace

void follow(const Session& session, const cli::Processes& processes, const ReadArguments& read)
{
    cli::MeshArguments arguments;
    const cli::Ending reading = cli::ending_of([&] { arguments = read(); });
    const int threads = threads_or_all(arguments.options.threads);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Order begun;
    std::unique_ptr<JoinedRun> run;
    for (;;) {
        const std::optional<Order> order = session.order();
        if (!order) {
            std::this_thread::sleep_for(kPause);
            continue;
        }
        if (order->kind == Order::Kind::end) return;
        if (order->kind == Order::Kind::begin) begun = *order;
        if (order->kind != Order::Kind::work) continue;
        session.send(done(session, [&](Log& log) {
            if (reading.exit_code != 0) throw RankError(reading.exit_code, reading.sentence);
            if (!run) run = std::make_unique<JoinedRun>(arguments, begun, session, processes);
            run->work(order->task.data(), log);
        }));
    }
}

} // namespace vcarve::mpi
