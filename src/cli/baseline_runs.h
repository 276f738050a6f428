#pragma once

#include "base/progress.h"
#include "cli/input_output.h"
#include "compare/compare.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::cli {

/// How COLMAP's mesher is run beside our own program.
struct BaselineRunOptions {
    int timeout_s = 300; ///< after which it is killed
};

/// A column of the table: the mesh of a program, or why there is none.
struct BaselineMesh {
    std::string name;
    std::string failure; ///< "timed out after 300 s"; empty where `mesh` was made
    TriMesh mesh;
    RunCost cost;
};

/// A new folder for what the baselines write, gone with all that is in it at the end.
class ScratchFolder {
  public:
    /// Throws UsageError where there is no place for it.
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    const std::filesystem::path& path() const { return path_; }
    /// The files that may be in it, and then itself: what is to be removed at an interruption.
    std::vector<std::filesystem::path> contents() const;

  private:
    std::filesystem::path path_;
};

/// Where COLMAP is, what it is run on, and how.
struct BaselineRun {
    std::string colmap;
    ModelArguments model;
    BaselineRunOptions options;
    int threads = 0; ///< limits both programs; 0 leaves them free
};

/// Runs `colmap delaunay_mesher` and this program with its defaults on the sparse or dense points
/// of the model. A program that fails gives a note instead of a column; one that times out gives a
/// column without a mesh. Call it before anything large is in memory (see run_child). Throws
/// InputError without a model, and UsageError for points that COLMAP cannot read.
std::vector<BaselineMesh> run_baselines(const BaselineRun& run, const ScratchFolder& scratch,
                                        Log& log);

/// How another program ended, and what it took.
struct ChildOutcome {
    RunCost cost;            ///< of the program and the ones it started and waited for
    bool timed_out = false;  ///< it was killed, with the ones it started
    bool succeeded = false;  ///< it ended by itself with exit code 0
    std::string description; ///< how it ended, to be read after its name: "ended with exit code 1"
};

/// Runs a program, found along PATH, in its own process group, with its output in the file
/// `printed`. The group is killed after `timeout_s` seconds, and ends with this process. Call it
/// while this process is small: the system counts the caller's memory at the start as the
/// program's.
ChildOutcome run_child(std::vector<std::string> words, const std::filesystem::path& printed,
                       double timeout_s);

} // namespace vcarve::cli
