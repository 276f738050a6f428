#include "tiles/reconstruct_tiles.h"

#include "base/free_memory.h"
#include "base/stage_counts.h"
#include "model/extent.h"
#include "model/scene_points.h"
#include "steps/1_points/arrange.h"
#include "tiles/measure_usual_values.h"
#include "tiles/tile_runs.h"
#include "tiles/tile_size.h"
#include "tiles/tile_state.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

namespace vcarve {

template <>
inline constexpr int kNumFields<Tiling> = 4;

namespace {

/// Refuses a file that only a new run can make again.
[[noreturn]] void refuse(const InputError& damage)
{
    throw InputError(fmt::format("{}; remove the work folder to start over", damage.what()));
}

/// Removes cameras and views, which the plan has.
Scene bare(Scene scene)
{
    scene.cameras.clear();
    scene.views.clear();
    return scene;
}

std::string read_name(std::size_t tile, std::size_t part)
{
    return fmt::format("tile-{}-read-{}", tile, part);
}

} // namespace

std::string TiledRun::name_of(std::size_t tile, File file)
{
    constexpr std::array<const char*, 3> kNames = {"points", "witnesses", "surface"};
    return fmt::format("tile-{}-{}", tile, kNames[static_cast<std::size_t>(file)]);
}

void TiledRun::plan(const PointSample& sample, const ReadPoints& read, std::size_t most)
{
    Stage stage(log_, "plan");
    if (folder_.has(kPlan)) {
        load_plan();
    } else {
        folder_.drop_all("tile-"); // of a plan that was not finished
        const Scene centered = center_points(sample.scene);
        frame_ = without_points(centered);
        tiling_ = divide(centered.positions, most, sample.one_in);
        divide_points(read, most, Progress(stage).part(0.0, 0.7));
        usual_ = measure_usual_values(
            tiling_.size(), [&](std::size_t tile) { return read_points(tile); }, options_, log_);
        usual_.radius = region_of_interest(centered).radius;
        usual_.points_of_witness = static_cast<double>(points_of_witness(sample.points));
        folder_.save(kPlan, frame_, tiling_, usual_, num_read_, num_parts_);
    }
    stage.end({{counts::kPlan.tiles, size_of(tiling_.size())},
               {counts::kPlan.points, size_of(sample.points)}});
}

/// Writes the points of each tile.
void TiledRun::divide_points(const ReadPoints& read, std::size_t most, const Progress& progress)
{
    constexpr std::size_t kLeast = 250'000; // points of a part
    num_read_.assign(tiling_.size(), 0);
    const auto write = [&](Scene part) {
        part = bare(std::move(part));
        move_origin(part, frame_.offset - part.offset);
        const auto by_tile = points_by_tile(tiling_, part.positions);
        for (std::size_t tile = 0; tile < by_tile.size(); ++tile) {
            if (by_tile[tile].empty()) continue;
            folder_.save(read_name(tile, num_parts_), selected(part, by_tile[tile]));
            num_read_[tile] += by_tile[tile].size();
        }
        ++num_parts_;
    };
    read(std::max(most, kLeast), write, progress);
}

/// Reads the points of a tile.
Scene TiledRun::read_points(std::size_t tile) const
{
    Scene points;
    try {
        for (std::size_t part = 0; part < num_parts_; ++part) {
            const std::string name = read_name(tile, part);
            if (!folder_.has(name)) continue; // no points
            Scene more;
            folder_.load(name, more);
            append_points(more, points, [](std::size_t) { return true; });
        }
        if (points.num_points() == num_read_[tile]) return in_frame(std::move(points));
        throw InputError(fmt::format("{}: found {} points of tile {}, expected {}",
                                     folder_.path().string(), points.num_points(), tile + 1,
                                     num_read_[tile]));
    } catch (const InputError& error) {
        refuse(error);
    }
}

/// Adds cameras and views to points of a file.
Scene TiledRun::in_frame(Scene points) const
{
    points.cameras = frame_.cameras;
    points.views = frame_.views;
    points.is_dense = frame_.is_dense;
    points.offset = frame_.offset;
    return points;
}

void TiledRun::load_plan()
{
    if (tiling_.size() > 0) return;
    try {
        folder_.load(kPlan, frame_, tiling_, usual_, num_read_, num_parts_);
    } catch (const InputError& error) {
        refuse(error);
    }
}

/// Loads what a tile has made, and makes it again if the file is damaged.
template <typename Made>
Made TiledRun::load(std::size_t tile, File file)
{
    const std::string name = name_of(tile, file);
    Made made;
    try {
        folder_.load(name, made);
        return made;
    } catch (const InputError& error) {
        log_.note(fmt::format("{}; it is computed again", error.what()));
    }
    make(tile, file);
    Made again;
    folder_.load(name, again);
    return again;
}

void TiledRun::make(std::size_t tile, File file)
{
    try {
        file == File::surface ? make_surface(tile) : make_points(tile);
    } catch (const InputError& error) {
        throw InputError(fmt::format("tile {} of {}: {}", tile + 1, tiling_.size(), error.what()));
    }
    return_freed_memory();
}

/// Adds the points of other tiles that are in the margin of a tile.
template <typename PointsOf>
void TiledRun::add_margin(std::size_t tile, const PointsOf& points_of, Scene& around) const
{
    const Eigen::AlignedBox3d region = tiling_.region(tile);
    for (std::size_t other = 0; other < tiling_.size(); ++other) {
        if (other == tile || !tiling_.are_near(tile, other)) continue;
        const Scene near = points_of(other);
        append_points(near, around,
                      [&](std::size_t point) { return region.contains(near.positions[point]); });
    }
}

void TiledRun::make_points(std::size_t tile)
{
    const auto points_of = [&](std::size_t which) { return read_points(which); };
    Scene around = points_of(tile);
    const std::size_t own = around.num_points();
    add_margin(tile, points_of, around);
    const Scene points =
        bare(tile_points(tile, std::move(around), own, {tiling_, options_, usual_, log_}));
    folder_.save(name_of(tile, File::witnesses),
                 witnesses_of(points, static_cast<std::size_t>(*usual_.points_of_witness)));
    folder_.save(name_of(tile, File::points), points);
}

void TiledRun::make_surface(std::size_t tile)
{
    const Eigen::AlignedBox3d region = tiling_.region(tile);
    const auto points_of = [&](std::size_t which) { return load<Scene>(which, File::points); };
    Scene around = in_frame(points_of(tile));
    add_margin(tile, points_of, around);
    for (std::size_t other = 0; other < tiling_.size(); ++other) {
        if (other == tile) continue;
        const auto far = load<Scene>(other, File::witnesses);
        append_points(far, around, [&](std::size_t point) {
            const Eigen::Vector3d& position = far.positions[point];
            return !region.contains(position) &&
                   std::ranges::any_of(far.tracks[point], [&](std::uint32_t view) {
                       return meets(region, position, frame_.views[view].center);
                   });
        });
    }
    folder_.save(name_of(tile, File::surface),
                 tile_surface(tile, std::move(around), {tiling_, options_, usual_, log_}));
}

/// Pauses while other processes work. Returns false if the process that led has ended.
bool TiledRun::waits(Stage& stage)
{
    stage.progress(0.0); // may throw Cancelled
    if (!folder_.leads() && (folder_.is_over() || folder_.try_lead())) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return true;
}

/// Makes the missing files of tiles that no other process makes. Returns their number, and the
/// number of files that others make.
std::pair<std::size_t, std::size_t> TiledRun::make_missing(File file, Stage& stage)
{
    std::size_t made = 0;
    std::size_t others = 0;
    for (std::size_t tile = 0; tile < tiling_.size(); ++tile) {
        const std::string name = name_of(tile, file);
        if (folder_.has(name)) continue;
        stage.progress(static_cast<double>(tile) / static_cast<double>(tiling_.size()));
        const FileLock claim = folder_.claim(name);
        if (!claim) ++others;
        if (!claim || folder_.has(name)) continue;
        if (!folder_.leads() && folder_.is_over()) return {made, 1}; // files are being removed
        make(tile, file);
        ++made;
    }
    return {made, others};
}

/// Makes a file of each tile, unless another process does. Returns whether all are made.
bool TiledRun::work(const char* stage_name, File file)
{
    tbb::task_arena arena(options_.threads == 0 ? tbb::task_arena::automatic : options_.threads);
    return arena.execute([&] {
        Stage stage(log_, stage_name);
        std::size_t all_made = 0;
        for (;;) {
            const auto [made, others] = make_missing(file, stage);
            all_made += made;
            if (others == 0) break;
            if (made == 0 && !waits(stage)) return false;
        }
        stage.end({{counts::kTileFiles.made, size_of(all_made), size_of(tiling_.size())}});
        return true;
    });
}

bool TiledRun::help()
{
    try {
        Stage stage(log_, "wait");
        while (!folder_.has(kPlan)) {
            if (!waits(stage)) return !folder_.leads();
        }
        load_plan();
        stage.end({{counts::kPlan.tiles, size_of(tiling_.size())}});
        if (!work("points", File::points) || !work("surfaces", File::surface))
            return !folder_.leads();
        Stage joining(log_, "wait");
        while (waits(joining)) {
        }
        if (!folder_.leads()) joining.end({});
        return !folder_.leads();
    } catch (const Error&) {
        // Files vanish when the process that leads is done.
        std::this_thread::sleep_for(std::chrono::seconds(1));
        if (!folder_.is_over()) throw;
        return true;
    }
}

TriMesh TiledRun::make()
{
    load_plan();
    work("points", File::points);
    work("surfaces", File::surface);
    Stage stage(log_, "join");
    const auto surface_of = [&](std::size_t tile) {
        stage.progress(static_cast<double>(tile) / static_cast<double>(tiling_.size()));
        return load<TileSurface>(tile, File::surface);
    };
    JoinedSurface joined =
        join_tiles(tiling_.size(), std::reduce(num_read_.begin(), num_read_.end()), surface_of,
                   options_.surface.cleanup.max_hole);
    if (joined.mesh.faces.empty()) {
        throw InputError("no surface found: too few rays pass behind the points; add images, or "
                         "dense points");
    }
    joined.mesh.offset = frame_.offset;
    stage.end({{counts::kJoin.faces, size_of(joined.mesh.faces.size())},
               {counts::kJoin.boundary_edges, joined.boundary_edges},
               {counts::kJoin.seam_edges, joined.seams.edges},
               {counts::kJoin.open, joined.seams.open},
               {counts::kJoin.holes, joined.seams.filled},
               {counts::kJoin.split, joined.seams.vertices}});
    return std::move(joined.mesh);
}

} // namespace vcarve
