#include "tiles/reconstruct_tiles.h"

#include "base/free_memory.h"
#include "model/scene_points.h"
#include "steps/1_points/arrange.h"
#include "tiles/measure_usual_values.h"
#include "tiles/tile_runs.h"
#include "tiles/tile_state.h"
#include "vcarve/error.h"

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vcarve {

template <>
inline constexpr int kNumFields<Tiling> = 4;

namespace {

/// Appends the points of another scene with the same views for which keeps(point) is true.
template <typename Keeps>
void append_if(const Scene& more, Scene& scene, const Keeps& keeps)
{
    const bool has_kinds = !scene.kinds.empty() || !more.kinds.empty();
    if (has_kinds) scene.kinds.resize(scene.num_points(), PointKind::measured);
    for (std::size_t point = 0; point < more.num_points(); ++point) {
        if (!keeps(point)) continue;
        scene.positions.push_back(more.positions[point]);
        if (!more.colors.empty()) scene.colors.push_back(more.colors[point]);
        scene.errors_px.push_back(more.errors_px[point]);
        scene.point_ids.push_back(more.point_ids[point]);
        if (!more.normals.empty()) scene.normals.push_back(more.normals[point]);
        if (has_kinds) scene.kinds.push_back(more.kind_of(point));
        scene.tracks.push_back(more.tracks[point]);
    }
}

/// Refuses a file that only a new run can make again.
[[noreturn]] void refuse(const InputError& damage)
{
    throw InputError(fmt::format("{}; remove the work folder to start over", damage.what()));
}

} // namespace

std::string TiledRun::name_of(std::size_t tile, File file)
{
    constexpr std::array<const char*, 4> kNames = {"read", "points", "witnesses", "surface"};
    return fmt::format("tile-{}-{}", tile, kNames[static_cast<std::size_t>(file)]);
}

void TiledRun::plan(Scene scene, std::size_t most)
{
    // Enough to prove free space in far tiles, and few enough to be read by each tile.
    constexpr std::size_t kWitnesses = 50'000;
    constexpr std::size_t kMostPoints = 16; // of one witness
    Stage stage(log_, "plan");
    if (folder_.has(kPlan)) {
        load_plan();
        stage.end({{"tiles", size_of(tiling_.size())}, {"points", size_of(num_points_)}});
        return;
    }
    scene = center_points(std::move(scene));
    UsualValues usual = measure_usual_values(scene, options_, log_);
    const std::size_t points_of_witness =
        std::clamp<std::size_t>(scene.num_points() / kWitnesses, 1, kMostPoints);
    usual.points_of_witness = static_cast<double>(points_of_witness);
    stage.progress(0.5);
    const Tiling tiling = divide(scene.positions, most);
    const std::vector<std::vector<std::uint32_t>> points = points_by_tile(tiling, scene.positions);
    for (std::size_t tile = 0; tile < tiling.size(); ++tile) {
        folder_.save(name_of(tile, File::read), {}, selected(scene, points[tile]));
        stage.progress(0.5 + 0.5 * static_cast<double>(tile) / static_cast<double>(tiling.size()));
    }
    folder_.save(kPlan, {}, without_points(scene), tiling, usual,
                 std::uint64_t{scene.num_points()});
    stage.end({{"tiles", size_of(tiling.size())}, {"points", size_of(scene.num_points())}});
}

void TiledRun::load_plan()
{
    if (tiling_.size() > 0) return;
    try {
        folder_.load(kPlan, {}, frame_, tiling_, usual_, num_points_);
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
        folder_.load(name, {}, made);
        return made;
    } catch (const InputError& error) {
        if (file == File::read) refuse(error);
        log_.note(fmt::format("{}; it is computed again", error.what()));
    }
    make(tile, file);
    Made again;
    folder_.load(name, {}, again);
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

void TiledRun::add_margin(std::size_t tile, File file, Scene& around)
{
    const Eigen::AlignedBox3d region = tiling_.region(tile);
    for (std::size_t other = 0; other < tiling_.size(); ++other) {
        if (other == tile || !tiling_.are_near(tile, other)) continue;
        const auto near = load<Scene>(other, file);
        append_if(near, around,
                  [&](std::size_t point) { return region.contains(near.positions[point]); });
    }
}

void TiledRun::make_points(std::size_t tile)
{
    Scene around = load<Scene>(tile, File::read);
    const std::size_t own = around.num_points();
    add_margin(tile, File::read, around);
    const Scene points =
        tile_points(tile, std::move(around), own, {tiling_, options_, usual_, log_});
    folder_.save(name_of(tile, File::witnesses), {},
                 witnesses_of(points, static_cast<std::size_t>(*usual_.points_of_witness)));
    folder_.save(name_of(tile, File::points), {}, points);
}

void TiledRun::make_surface(std::size_t tile)
{
    const Eigen::AlignedBox3d region = tiling_.region(tile);
    Scene around = load<Scene>(tile, File::points);
    add_margin(tile, File::points, around);
    for (std::size_t other = 0; other < tiling_.size(); ++other) {
        if (other == tile) continue;
        const auto far = load<Scene>(other, File::witnesses);
        append_if(far, around, [&](std::size_t point) {
            const Eigen::Vector3d& position = far.positions[point];
            return !region.contains(position) &&
                   std::ranges::any_of(far.tracks[point], [&](std::uint32_t view) {
                       return meets(region, position, far.views[view].center);
                   });
        });
    }
    folder_.save(name_of(tile, File::surface), {},
                 tile_surface(tile, std::move(around), {tiling_, options_, usual_, log_}));
}

void TiledRun::work(const std::string& task, std::size_t most)
{
    const bool is_points = task == kPointsTask;
    if (!is_points && task != kSurfacesTask) throw std::logic_error("unknown task for a rank");
    load_plan();
    tbb::task_arena arena(options_.threads == 0 ? tbb::task_arena::automatic : options_.threads);
    arena.execute([&] {
        Stage stage(log_, is_points ? "points" : "surfaces");
        std::size_t made = 0;
        for (std::size_t tile = 0; tile < tiling_.size() && made < most; ++tile) {
            if (ranks_ != nullptr && ranks_->has_failed()) break; // their error is reported
            const File file = is_points ? File::points : File::surface;
            stage.progress(static_cast<double>(tile) / static_cast<double>(tiling_.size()));
            const std::string name = name_of(tile, file);
            if (folder_.has(name) || !folder_.claim(name)) continue;
            make(tile, file);
            ++made;
        }
        stage.end({{"tiles", size_of(made)}, {"of", size_of(tiling_.size())}});
    });
}

TriMesh TiledRun::make(Ranks* ranks)
{
    ranks_ = ranks;
    for (const char* task : {kPointsTask, kSurfacesTask}) {
        if (ranks == nullptr) {
            work(task);
        } else {
            ranks->share(task, [&] { work(task); });
        }
    }
    load_plan();
    Stage stage(log_, "join");
    const auto surface_of = [&](std::size_t tile) {
        stage.progress(static_cast<double>(tile) / static_cast<double>(tiling_.size()));
        return load<TileSurface>(tile, File::surface);
    };
    JoinedSurface joined =
        join_tiles(tiling_.size(), surface_of, options_.surface.cleanup.max_hole);
    if (joined.mesh.faces.empty()) {
        throw InputError("no surface found: too few rays pass behind the points; add images, or "
                         "dense points");
    }
    joined.mesh.offset = frame_.offset;
    stage.end({{"faces", size_of(joined.mesh.faces.size())},
               {"boundary edges", joined.boundary_edges},
               {"seam edges", joined.seams.edges},
               {"open", joined.seams.open},
               {"holes filled", joined.seams.filled},
               {"vertices split", joined.seams.vertices}});
    return std::move(joined.mesh);
}

} // namespace vcarve
