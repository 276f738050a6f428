#pragma once

#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>

namespace vcarve {

/// One process of a run that several work on, as MPI counts them.
struct Rank {
    std::size_t number = 0; ///< from 0
    std::size_t of = 1;
};

/// Another rank failed: what() is its sentence. The model need not be at fault.
class RankError : public std::runtime_error {
  public:
    RankError(int exit_code, const std::string& sentence)
        : std::runtime_error(sentence), exit_code_(exit_code)
    {
    }
    int exit_code() const { return exit_code_; }

  private:
    int exit_code_; ///< what the program is to end with
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
    /// throws, and RankError where another rank failed; then the rest is stopped.
    virtual void share(const std::string& task, const std::function<void()>& own) = 0;
    /// Whether another rank has failed, so that own() should stop. From any thread.
    virtual bool has_failed() const { return false; }
};

} // namespace vcarve
