#pragma once

#include "cli/run_memory.h"
#include "mpi/orders.h"
#include "run/ranks.h"

#include <optional>
#include <string>

namespace vcarve::mpi {

/// MPI, begun when the object is made and ended when it goes. One thread at a time may call. What
/// a call of MPI does not do ends all ranks, as MPI's own handler of errors says.
class Session {
  public:
    Session(int* count, char*** words);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();

    Rank rank() const;
    cli::Processes processes() const;
    /// "rank 3 on host".
    std::string name() const;

    void send(const Order& order, std::size_t rank) const;
    void send(const Reply& reply) const;
    /// What has arrived, if anything has: an order of rank 0; a reply, and whose it is.
    std::optional<Order> order() const;
    struct Replied {
        std::size_t rank;
        Reply reply;
    };
    std::optional<Replied> reply() const;
};

} // namespace vcarve::mpi
