#include "mpi/session.h"

#include <fmt/format.h>
#include <mpi.h>

#include <array>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace vcarve::mpi {

namespace {

constexpr int kOrders = 1;
constexpr int kReplies = 2;
constexpr std::chrono::milliseconds kMessagePause(1);

int rank_in(MPI_Comm communicator)
{
    int rank = 0;
    MPI_Comm_rank(communicator, &rank);
    return rank;
}

std::size_t size_of(MPI_Comm communicator)
{
    int size = 1;
    MPI_Comm_size(communicator, &size);
    return static_cast<std::size_t>(size);
}

/// Sends a message. MPI_Send would keep a core busy until the other rank receives, which may be at
/// the end of a long share.
template <typename Message>
void send(const Message& message, int rank, int tag)
{
    MPI_Request request = MPI_REQUEST_NULL;
    MPI_Isend(&message, sizeof(message), MPI_BYTE, rank, tag, MPI_COMM_WORLD, &request);
    for (;;) {
        int is_sent = 0;
        MPI_Test(&request, &is_sent, MPI_STATUS_IGNORE);
        if (is_sent != 0) return;
        std::this_thread::sleep_for(kMessagePause);
    }
}

/// Receives a message if one has arrived. Returns its sender, or nullopt.
template <typename Message>
std::optional<int> receive(Message& message, int tag)
{
    int has_arrived = 0;
    MPI_Status status = {};
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &has_arrived, &status);
    if (has_arrived == 0) return std::nullopt;
    const int sender = status.MPI_SOURCE;
    MPI_Recv(&message, sizeof(message), MPI_BYTE, sender, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return sender;
}

} // namespace

Session::Session(int* count, char*** words)
{
    int provided = 0;
    MPI_Init_thread(count, words, MPI_THREAD_SERIALIZED, &provided);
    if (provided < MPI_THREAD_SERIALIZED) {
        throw std::runtime_error("this MPI library does not support calls from several threads");
    }
}

Session::~Session()
{
    MPI_Finalize();
}

Rank Session::rank() const
{
    return {static_cast<std::size_t>(rank_in(MPI_COMM_WORLD)), size_of(MPI_COMM_WORLD)};
}

std::string Session::name() const
{
    std::array<char, MPI_MAX_PROCESSOR_NAME> host{};
    int length = 0;
    MPI_Get_processor_name(host.data(), &length);
    return fmt::format("rank {} on {}", rank_in(MPI_COMM_WORLD), host.data());
}

void Session::send(const Order& order, std::size_t rank) const
{
    mpi::send(order, static_cast<int>(rank), kOrders);
}

void Session::send(const Reply& reply) const
{
    mpi::send(reply, 0, kReplies);
}

std::optional<Order> Session::order() const
{
    Order order;
    if (!receive(order, kOrders)) return std::nullopt;
    return order;
}

std::optional<Session::Replied> Session::reply() const
{
    Reply reply;
    const std::optional<int> sender = receive(reply, kReplies);
    if (!sender) return std::nullopt;
    return Replied{static_cast<std::size_t>(*sender), reply};
}

} // namespace vcarve::mpi
