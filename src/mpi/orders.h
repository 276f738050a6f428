#pragma once

#include "run/digest.h"

#include <array>
#include <cstdint>
#include <string_view>

// What ranks tell each other by MPI: little, for all else goes through the work folder.

namespace vcarve::mpi {

/// From rank 0 to the others.
struct Order {
    enum class Kind : std::int32_t {
        begin, ///< a run: its job, and a digest of its options
        work,  ///< on its share of a task
        stop,  ///< that work; also told to who has done it meanwhile
        end,   ///< of the program
    };
    Kind kind = Kind::end;
    std::int32_t in_files = 0;   ///< of a run: large arrays are
    std::array<char, 64> task{}; ///< the name of its file, to work on
    Digest job{};
    Digest options{};
};

/// From another rank to rank 0, when its share is done or has failed.
struct Reply {
    std::int32_t exit_code = 0;        ///< what the program would end with
    std::int32_t was_stopped = 0;      ///< as it was ordered
    std::array<char, 1000> sentence{}; ///< what went wrong
};

/// Copies a text that fits, but for its end where it does not; zeros follow it.
template <std::size_t kSize>
void set_text(std::array<char, kSize>& place, std::string_view text)
{
    place.fill(0);
    text.substr(0, kSize - 1).copy(place.data(), kSize - 1);
}

} // namespace vcarve::mpi
