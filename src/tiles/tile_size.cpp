#include "tiles/tile_size.h"

#include "base/text.h"
#include "pipeline/memory.h"
#include "tiles/tiling.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// Bytes per point of the joined mesh, which has two faces per point: position, normal, color.
constexpr double kMeshPoint = 24 + 12 + 3 + 2 * 12;

/// The size of a tile of `points` points with its margin, and with half of all witnesses. Rays of
/// the others do not meet the tile.
SceneSize size_with_margin(const SceneSize& model, double points)
{
    const auto all = static_cast<double>(model.points);
    const double side = std::sqrt(points) + 2.0 * kMarginSpacings;
    const double one_in = static_cast<double>(points_of_witness(model.points));
    const double around = std::min(all, side * side + all / one_in / 2.0);
    SceneSize size = model;
    size.points = static_cast<std::uint64_t>(around);
    size.rays = static_cast<std::uint64_t>(static_cast<double>(model.rays) * around / all);
    return size;
}

/// The expected peak memory of a run in tiles of `points` points.
std::int64_t predicted_memory_of_tiles(const SceneSize& model, const Options& options,
                                       std::size_t points)
{
    constexpr int kThreads = 16; // each needs little
    const SceneSize tile = size_with_margin(model, static_cast<double>(points));
    const std::int64_t peak = predicted_peak(
        {.read = tile, .thinned = tile, .options = options, .is_tile = true}, kThreads);
    const double mesh = kMeshPoint * static_cast<double>(model.points + points);
    return std::max(peak, static_cast<std::int64_t>(mesh));
}

} // namespace

std::size_t points_of_witness(std::size_t points)
{
    constexpr std::size_t kWitnesses = 50'000;
    constexpr std::size_t kMost = 16;
    return std::clamp<std::size_t>(points / kWitnesses, 1, kMost);
}

std::size_t points_of_tile(const SceneSize& model, const Options& options, std::int64_t most)
{
    constexpr std::size_t kLeast = 1000;
    std::size_t points = kLeast;
    const std::int64_t least = predicted_memory_of_tiles(model, options, points);
    if (least > most) {
        throw InputError(fmt::format("{} points with {} rays need about {} of memory even in "
                                     "tiles, and --max-memory allows {}",
                                     model.points, model.rays, byte_size_text(least),
                                     byte_size_text(most)));
    }
    while (points < model.points && predicted_memory_of_tiles(model, options, 2 * points) <= most) {
        points *= 2;
    }
    return points;
}

} // namespace vcarve
