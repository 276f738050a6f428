#pragma once

#include "base/progress.h"
#include "model/scene_points.h"
#include "model/usual_values.h"
#include "run/work_folder.h"
#include "tiles/join.h"
#include "vcarve/log.h"
#include "vcarve/options.h"
#include "vcarve/scene.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace vcarve {

/// Reads the points of a model in parts of at most `most`.
using ReadPoints =
    std::function<void(std::size_t most, const TakePoints& take, const Progress& progress)>;

/// Reconstructs a model in tiles (tiling.h), so that time and memory divide by their number:
///   - plan: usual values of the whole model, the tiling, and the points of each tile in a file,
///   - points: each tile filters, denoises and completes its points,
///   - surfaces: each tile makes the faces that it owns, from its points, those in its margin, and
///     witnesses: a sample of farther points, whose rays carve,
///   - join: tiles meet at vertices with equal names.
/// All results are files of the work folder, so a run that was stopped resumes after the last
/// finished tile, and several processes take tiles one by one. The result does not depend on the
/// number of threads and processes; it differs from that of reconstruct() mainly near the borders
/// of tiles.
class TiledRun {
  public:
    /// `folder` was begun. All arguments must outlive the object.
    TiledRun(WorkFolder& folder, const Options& options, Log& log)
        : folder_(folder), options_(options), log_(log)
    {
    }

    /// Divides a model into tiles of at most `most` points, unless the folder has them already.
    /// `sample` has all views.
    void plan(const PointSample& sample, const ReadPoints& read, std::size_t most);
    /// Makes what the tiles still lack, and joins their surfaces.
    TriMesh make();
    /// Shares the work of the process that leads the folder, until that is done. Returns true then,
    /// or false if the process ended before, and this one leads now.
    bool help();

    static constexpr const char* kPlan = "tiles"; ///< the stage that all processes need

  private:
    /// The files of a tile.
    enum class File : std::uint8_t { points, witnesses, surface };

    bool waits(Stage& stage);
    std::pair<std::size_t, std::size_t> make_missing(File file, Stage& stage);
    bool work(const char* stage_name, File file);
    static std::string name_of(std::size_t tile, File file);
    void divide_points(const ReadPoints& read, std::size_t most, const Progress& progress);
    Scene read_points(std::size_t tile) const;
    Scene in_frame(Scene points) const;
    template <typename PointsOf>
    void add_margin(std::size_t tile, const PointsOf& points_of, Scene& around) const;
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
    std::vector<std::uint64_t> num_read_; ///< points of each tile
    std::uint64_t num_parts_ = 0;         ///< files that a tile may have of its points
};

} // namespace vcarve
