#pragma once

#include "io/work/digest.h"
#include "io/work/ranks.h"
#include "vcarve/options.h"

#include <cstddef>

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

    /// Tells the others, before anything is shared, which job it is, and of which options.
    virtual void begin(const Digest& job, const Digest& options) = 0;
};

/// Differs where options, or programs, make other surfaces.
Digest digest_of_options(const Options& options);

} // namespace vcarve::cli
