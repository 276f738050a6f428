#pragma once

#include "run/digest.h"
#include "run/ranks.h"
#include "vcarve/options.h"

#include <cstddef>

namespace vcarve::cli {

/// How many processes work on a run.
struct Processes {
    std::size_t all = 1;
    std::size_t here = 1; ///< on this machine
};

/// What ranks have to agree on.
struct JobOfRanks {
    Digest job{};          ///< of the work folder
    Digest options{};      ///< see digest_of_options()
    bool in_files = false; ///< large arrays are in the work folder
};

/// The other processes of a run, as its command knows them.
class RunRanks : public Ranks {
  public:
    virtual Processes processes() const = 0;
    std::size_t count() const override { return processes().all; }

    /// Tells the others, before anything is shared, what run it is.
    virtual void begin(const JobOfRanks& job) = 0;
};

/// Differs where options, or programs, make other surfaces.
Digest digest_of_options(const Options& options);

} // namespace vcarve::cli
