#pragma once

#include "run/digest.h"

#include <array>
#include <cstdint>
#include <string_view>

// The messages between ranks. They are short, because all data goes through the work folder.

namespace vcarve::mpi {

/// A message from rank 0 to another rank.
struct Order {
    enum class Kind : std::int32_t {
        begin, ///< a run begins; has its job, and a digest of its options
        work,  ///< do the share of a task
        stop,  ///< cancel the share; also sent to ranks that are already done
        end,   ///< end the program
    };
    Kind kind = Kind::end;
    std::array<char, 64> task{}; ///< work: the name of the task
    Digest job{};
    Digest options{};
};

/// A message to rank 0 that a share is done or has failed.
struct Reply {
    std::int32_t exit_code = 0;        ///< of the program, if the share failed
    std::int32_t was_stopped = 0;      ///< whether an order stopped the share
    std::array<char, 1000> sentence{}; ///< the error message
};

/// Copies a text, truncated if it does not fit, and fills the rest with at least one zero.
template <std::size_t kSize>
void set_text(std::array<char, kSize>& place, std::string_view text)
{
    place.fill(0);
    text.substr(0, kSize - 1).copy(place.data(), kSize - 1);
}

} // namespace vcarve::mpi
