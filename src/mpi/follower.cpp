#include "mpi/follower.h"

#include "base/threads.h"
#include "cli/exit_code.h"
#include "cli/run_memory.h"
#include "run/work_folder.h"
#include "tiles/reconstruct_tiles.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <atomic>
#include <chrono>
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

/// Does a share of a run on a rank.
void work(const cli::MeshArguments& arguments, const Order& begun, const char* task, Log& log)
{
    if (begun.options != cli::digest_of_options(arguments.options)) {
        throw UsageError("it was started with other options or another program than rank 0");
    }
    WorkFolder folder(arguments.work, begun.job);
    {
        Stage stage(log, "wait");
        folder.wait_for(TiledRun::kPlan, stage);
    }
    const Options options = cli::options_of_tiles(arguments.options);
    TiledRun(folder, options, log).work(task);
}

/// Does a share on another thread, so that this thread can receive orders to stop.
Reply done(const Session& session, const std::function<void(Log&)>& share)
{
    QuietLog log;
    cli::Ending ending;
    bool was_stopped = false;
    std::atomic<bool> is_done = false;
    std::thread worker([&] {
        ending = cli::ending_of([&] {
            try {
                share(log);
            } catch (const Cancelled&) {
                was_stopped = true;
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

void follow(const Session& session, const ReadArguments& read)
{
    cli::MeshArguments arguments;
    const cli::Ending reading = cli::ending_of([&] { arguments = read(); });
    const int threads = threads_or_all(arguments.options.threads);
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));
    Order begun;
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
            work(arguments, begun, order->task.data(), log);
        }));
    }
}

} // namespace vcarve::mpi
