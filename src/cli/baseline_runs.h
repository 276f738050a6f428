#pragma once

#include "base/progress.h"
#include "cli/input_output.h"
#include "compare/compare.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vcarve::cli {

/// Options of the run of COLMAP's mesher.
struct BaselineRunOptions {
    int timeout_s = 300; ///< the mesher is killed after this time
};

/// A column of the table: the mesh of a program, or the reason why it has none.
struct BaselineMesh {
    std::string name;
    std::string failure; ///< "timed out after 300 s"; empty if there is a mesh
    TriMesh mesh;
    RunCost cost;
};

/// A new folder for the files of the baselines. The destructor removes it with its content.
class ScratchFolder {
  public:
    /// Throws UsageError if it cannot be created.
    ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;
    ~ScratchFolder();

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// COLMAP's program, its input and its options.
struct BaselineRun {
    std::string colmap;
    const ModelArguments& model;
    const FoundInput& found;
    BaselineRunOptions options;
    int threads = 0; ///< maximum threads of either program; 0 disables
};

/// Runs `colmap delaunay_mesher` and this program with its defaults on the sparse or dense points
/// of the model. A failure causes a note instead of a column, and a timeout a column without a
/// mesh. Call it before anything large is in memory (see run_child). Throws InputError if there is
/// no model, and UsageError if COLMAP cannot read the points.
std::vector<BaselineMesh> run_baselines(const BaselineRun& run, const ScratchFolder& scratch,
                                        Log& log);

/// The outcome and the cost of another program.
struct ChildOutcome {
    RunCost cost;            ///< of the program and of the children it waited for
    bool timed_out = false;  ///< its process group was killed
    bool succeeded = false;  ///< it exited with code 0
    std::string description; ///< a phrase after the program's name: "exited with code 1"
};

/// Runs a program from PATH in its own process group, with its output in the file `printed`. The
/// group is killed after `timeout_s` seconds; the program gets SIGTERM if this process ends. Call
/// it while this process is small: the system counts the caller's memory at the start as the
/// program's.
ChildOutcome run_child(std::vector<std::string> words, const std::filesystem::path& printed,
                       double timeout_s);

} // namespace vcarve::cli
