#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace vcarve {

/// One of the processes of a run, as in MPI.
struct Rank {
    std::size_t number = 0; ///< from 0
    std::size_t of = 1;
};

/// Another rank failed; what() is its message. The cause may not be the model.
class RankError : public std::runtime_error {
  public:
    RankError(int exit_code, const std::string& sentence)
        : std::runtime_error(sentence), exit_code_(exit_code)
    {
    }
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_; ///< of the program
};

/// All processes of a run, as seen by rank 0. Rank 0 runs the steps, and the others do shares of
/// some steps. They share only the work folder, so tasks and results are files in it.
class Ranks {
  public:
    Ranks() = default;
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    virtual ~Ranks() = default;

    /// The number of ranks, including this one.
    virtual std::size_t count() const = 0;

    /// Lets every other rank do its share of the task in the stage file `task` of the work folder,
    /// calls own() meanwhile, and returns when all are done. Throws what own() throws, and
    /// RankError if another rank failed; the remaining ranks are then stopped.
    virtual void share(const std::string& task, const std::function<void()>& own) = 0;
    /// Whether another rank has failed, so that own() should stop. Thread-safe.
    virtual bool has_failed() const { return false; }
};

} // namespace vcarve
