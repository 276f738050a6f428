#include "mpi/leader.h"

#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace vcarve::mpi {

namespace {

constexpr std::chrono::milliseconds kAnswerPause(10);

} // namespace

Leader::~Leader()
{
    report_all({.kind = Order::Kind::end});
}

void Leader::report_all(const Order& order) const
{
    for (std::size_t rank = 1; rank < count(); ++rank) {
        session_.send(order, rank);
    }
}

void Leader::begin(const cli::JobOfRanks& job)
{
    report_all({.kind = Order::Kind::begin, .job = job.job, .options = job.options});
}

/// Waits until all other ranks are done, and returns the first failure. A failure, or setting
/// `stops`, stops the other ranks.
std::optional<RankError> Leader::gather(const std::atomic<bool>& stops)
{
    std::optional<RankError> failure;
    bool are_stopped = false;
    for (std::size_t left = count() - 1; left > 0;) {
        if ((stops || failure) && !std::exchange(are_stopped, true)) {
            report_all({.kind = Order::Kind::stop});
        }
        const std::optional<Session::Replied> replied = session_.reply();
        if (!replied) {
            std::this_thread::sleep_for(kAnswerPause);
            continue;
        }
        --left;
        const Reply& reply = replied->reply;
        if (reply.exit_code == 0 || reply.was_stopped != 0 || failure) continue;
        failure.emplace(reply.exit_code, reply.sentence.data());
        has_failed_ = true;
    }
    return failure;
}

void Leader::share(const std::string& task, const std::function<void()>& own)
{
    Order order = {.kind = Order::Kind::work};
    set_text(order.task, task);
    report_all(order);
    has_failed_ = false;
    std::atomic<bool> own_failed = false;
    std::optional<RankError> failure;
    // Until this thread ends, no other thread calls MPI.
    std::thread gatherer([&] { failure = gather(own_failed); });
    std::exception_ptr own_failure;
    try {
        own();
    } catch (...) {
        own_failure = std::current_exception();
        own_failed = true;
    }
    gatherer.join();
    if (failure) throw RankError(*failure); // if own() failed too, it was stopped
    if (own_failure) std::rethrow_exception(own_failure);
}

} // namespace vcarve::mpi
