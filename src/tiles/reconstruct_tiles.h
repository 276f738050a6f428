#pragma once

#include "model/usual_values.h"
#include "run/ranks.h"
#include "run/work_folder.h"
#include "tiles/join.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace vcarve {

/// Reconstructs a model in tiles (tiling.h), so that time and memory divide by their number:
///   - plan: usual values of the whole model, the tiling, and the points of each tile in a file,
///   - points: each tile filters, denoises and completes its points,
///   - surfaces: each tile makes the faces that it owns, from its points, those in its margin, and
///     witnesses: a sample of farther points, whose rays carve,
///   - join: tiles meet at vertices with equal names.
/// All results are files of the work folder, so a run that was stopped resumes after the last
/// finished tile, and ranks take tiles one by one. The result does not depend on the number of
/// threads and ranks; it differs from that of reconstruct() mainly near the borders of tiles.
class TiledRun {
  public:
    /// `folder` was begun or joined. All arguments must outlive the object.
    TiledRun(WorkFolder& folder, const Options& options, Log& log)
        : folder_(folder), options_(options), log_(log)
    {
    }

    /// Divides a scene into tiles of at most `most` points, unless the folder has them already.
    void plan(Scene scene, std::size_t most);
    /// Does the tasks, which `ranks` share unless it is null, and joins their results.
    TriMesh make(Ranks* ranks);

    /// Makes tiles of a task, `kPointsTask` or `kSurfacesTask`, until none is left or `most` are
    /// made.
    void work(const std::string& task, std::size_t most = SIZE_MAX);

    static constexpr const char* kPlan = "tiles"; ///< the stage that tasks need
    static constexpr const char* kPointsTask = "task-points";
    static constexpr const char* kSurfacesTask = "task-surfaces";

  private:
    /// The files of a tile.
    enum class File : std::uint8_t { read, points, witnesses, surface };

    static std::string name_of(std::size_t tile, File file);
    /// Adds the points of other tiles that are in the margin of a tile.
    void add_margin(std::size_t tile, File file, Scene& around);
    void make_points(std::size_t tile);
    void make_surface(std::size_t tile);
    void make(std::size_t tile, File file);
    void load_plan();
    template <typename Made>
    Made load(std::size_t tile, File file);

    WorkFolder& folder_;
    const Options& options_;
    Log& log_;
    Scene frame_; ///< cameras and views
    Tiling tiling_;
    UsualValues usual_;
    std::uint64_t num_points_ = 0; ///< of the model
    const Ranks* ranks_ = nullptr; ///< others, while they work
};

} // namespace vcarve
