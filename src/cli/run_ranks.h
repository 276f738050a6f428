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

/// What each process of a run may take.
struct RankMemory {
    std::int64_t most = 0; ///< bytes; 0 for all there is
    bool in_files = false; ///< arrays are in the work folder
};

/// The other processes of a run, as its command knows them.
class RunRanks : public Ranks {
  public:
    virtual Processes processes() const = 0;
    std::size_t count() const override { return processes().all; }

    /// Tells the others, before anything is shared, which job it is and what memory each of
    /// them has.
    virtual void begin(const Digest& job, const RankMemory& memory) = 0;
};

} // namespace vcarve::cli
