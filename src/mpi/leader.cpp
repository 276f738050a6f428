#include "mpi/leader.h"

#include "vcarve/error.h"

#include <chrono>
#include <exception>
#include <stdexcept>
#include <string>
#include <thread>

namespace vcarve::mpi {

namespace {

constexpr std::chrono::milliseconds kPause(10);

/// What the run of rank 0 ends with where another rank failed.
[[noreturn]] void fail_as(const Reply& reply)
{
    const std::string sentence = reply.sentence.data();
    if (reply.exit_code == 2) throw UsageError(sentence);
    if (reply.exit_code == 3) throw InputError(sentence);
    throw std::runtime_error(sentence);
}

} // namespace

Leader::~Leader()
{
    tell_all({.kind = Order::Kind::end});
}

void Leader::tell_all(const Order& order) const
{
    for (std::size_t rank = 1; rank < processes_.all; ++rank) {
        session_.send(order, rank);
    }
}

void Leader::begin(const Digest& job, const cli::RankMemory& memory)
{
    tell_all({.kind = Order::Kind::begin,
              .keeps_in_files = memory.in_files ? 1 : 0,
              .job = job,
              .most_memory = memory.most});
}

/// Throws what the first of them failed with, when the others have stopped.
void Leader::wait_for_all()
{
    std::optional<Reply> failure;
    for (std::size_t left = processes_.all - 1; left > 0;) {
        const std::optional<Session::Replied> replied = session_.reply();
        if (!replied) {
            std::this_thread::sleep_for(kPause);
            continue;
        }
        --left;
        const bool has_failed = replied->reply.exit_code != 0 && replied->reply.was_stopped == 0;
        if (!has_failed || failure) continue;
        failure = replied->reply;
        tell_all({.kind = Order::Kind::stop});
    }
    if (failure) fail_as(*failure);
}

void Leader::share(const std::string& task, const std::function<void()>& own)
{
    Order order = {.kind = Order::Kind::work};
    set_text(order.task, task);
    tell_all(order);
    std::exception_ptr failure;
    try {
        own();
    } catch (...) {
        failure = std::current_exception();
        tell_all({.kind = Order::Kind::stop});
    }
    try {
        wait_for_all();
    } catch (...) {
        if (!failure) throw;
    }
    if (failure) std::rethrow_exception(failure);
}

} // namespace vcarve::mpi
