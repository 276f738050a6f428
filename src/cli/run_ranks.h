#pragma once

#include "io/work/digest.h"
#include "io/work/ranks.h"

#include <cstddef>
#include <cstdint>

namespace vcarve::cli {

/// How many processes work on a run.
struct Processes {
    std::size_t all = 1;
    std::size_t here = 1; ///< on this machine
};

/// The other processes of a run, as its command knows them.
class RunRanks : public Ranks {
  public:
    virtual Processes processes() const = 0;
    std::size_t count() const override { return processes().all; }

    /// Tells the others, before anything is shared, which job it is and how much memory each of
    /// them may take, in bytes; 0 for all there is.
    virtual void begin(const Digest& job, std::int64_t most_memory) = 0;
};

} // namespace vcarve::cli
