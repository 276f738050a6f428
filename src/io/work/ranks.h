#pragma once

#include <cstddef>
#include <functional>
#include <string>

namespace vcarve {

/// One process of a run that several work on, as MPI counts them.
struct Rank {
    std::size_t number = 0; ///< from 0
    std::size_t of = 1;
};

/// All processes of a run, for the first of them, rank 0: it takes the run's steps, and the others
/// do their shares of some. They have the work folder in common and nothing else, so a share is
/// told by a file there, and its results are files, too.
class Ranks {
  public:
    Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    virtual ~Ranks() = default;

    /// With this one.
    virtual std::size_t count() const = 0;

    /// Has every other rank do its share of what the stage file `task` of the run's work folder
    /// asks for, calls own() here meanwhile, and returns when all are done. Throws what own()
    /// throws, and UsageError or InputError with the sentence of the rank that failed.
    virtual void share(const std::string& task, const std::function<void()>& own) = 0;
};

} // namespace vcarve
