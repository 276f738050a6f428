#pragma once

#include "io/input/read_model.h"
#include "io/input/run_input.h"
#include "pipeline/scene_run.h"
#include "run/work_folder.h"
#include "tiles/run_memory.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <filesystem>
#include <memory>

namespace vcarve {

/// What a run keeps, where, and what it needs.
struct RunPlan {
    std::unique_ptr<WorkFolder> work{};  ///< for depth maps and tiles; null keeps none
    bool keeps_work = false;             ///< also after the run has ended
    std::filesystem::path scratch{};     ///< folder of tiles without `work`, which the run creates
    std::filesystem::path keep_points{}; ///< PLY file of dense points; empty writes none
    std::size_t tile_points = 0;         ///< maximum number of points of a tile; 0: memory decides
    bool needs_one_piece = false;        ///< tiles are impossible
    bool wants_report = false;           ///< collects data of --report
};

/// A run from the files of a model to the mesh, in one piece or in tiles. It begins the work
/// folder, resumes what an earlier run kept there, shares tiles with other processes, and clears
/// the folder when the run has ended. A run that fails keeps what a later one can use.
///
///     ModelRun run(input, options, plan, log);
///     if (run.is_made_by_another(out)) return;
///     ReadModel model = run.read();
///     ReportedRun made = run.make(std::move(model));
///     write(made); // the caller
///     run.end();
class ModelRun {
  public:
    /// All arguments but `plan` must outlive the object. `options` are resolved(). Throws
    /// InputError if another run uses the work folder. Cost with a work folder: the digest of all
    /// inputs.
    ModelRun(const RunInput& input, const Options& options, RunPlan plan, Log& log);
    ModelRun(const ModelRun&) = delete;
    ModelRun& operator=(const ModelRun&) = delete;
    ~ModelRun();

    /// Shares the tiles of another process with the same command, if there is one. Returns whether
    /// that made the mesh `out`. Throws InputError if it ended without the mesh.
    bool is_made_by_another(const std::filesystem::path& out);

    /// Reads the points: all of them, merged, or a sample for tiles. Throws as read_found_model(),
    /// and InputError if the memory is insufficient.
    ReadModel read();
    /// Makes the mesh. Errors name the model.
    ReportedRun make(ReadModel model);
    /// Clears the work folder, unless it is to be kept. Call it when all is written.
    void end();

    const RunMemory& memory() const { return memory_; }

  private:
    Job job() const;
    void fit_memory(const RunSize& size);
    DepthMap kept_depth(std::size_t photo, const std::function<DepthMap()>& make) const;
    ReportedRun made_of(ReadModel model);
    ReportedRun made_in_tiles(ReadModel model);
    Options options_of_tiles() const;

    const RunInput& input_;
    const Options& options_;
    RunPlan plan_;
    Log& log_;
    SceneRun run_;
    RunMemory memory_;
    bool is_temporary_ = false; ///< the work folder is `scratch`
};

} // namespace vcarve
