#pragma once

#include "cli/run_memory.h"
#include "mpi/orders.h"
#include "run/ranks.h"

#include <optional>
#include <string>

namespace vcarve::mpi {

/// Initializes MPI, and finalizes it in the destructor. Only one thread at a time may call. A
/// failed MPI call ends all ranks, which is MPI's default error handler.
class Session {
  public:
    Session(int* count, char*** words);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();

    Rank rank() const;
    /// "rank 3 on host".
    std::string name() const;

    void send(const Order& order, std::size_t rank) const;
    void send(const Reply& reply) const;
    /// The next message that has arrived, if any: an order of rank 0, or a reply and its sender.
    std::optional<Order> order() const;
    struct Replied {
        std::size_t rank;
        Reply reply;
    };
    std::optional<Replied> reply() const;
};

} // namespace vcarve::mpi
