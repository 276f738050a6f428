#include "pipeline/memory.h"

#include "base/text.h"
#include "pipeline/stages.h"
#include "vcarve/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

/// Bytes of code, libraries and small objects; bytes per thread of stack and allocator caches.
constexpr double kProgram = 12.5e6;
constexpr double kThread = 0.5e6;

/// Bytes per point of a block: CGAL's triangulation of the block with the points around it.
constexpr double kBlockPoint = 600;
/// Heap bytes per point of a run in blocks: arrays that are too small for scratch files (measured:
/// 22 bytes for 5 M points).
constexpr double kHeapPoint = 24;
/// Additional heap bytes per point while planar regions are searched: nodes of the k-d tree, and
/// points of regions.
constexpr double kHeapAddedPoint = 42;
/// Ratio of files in the work folder to the predicted memory of a stage: growing arrays are stored
/// twice.
constexpr double kScratchMargin = 1.1;

std::int64_t rounded(double bytes)
{
    return std::llround(std::min(bytes, 0x1p62));
}

std::vector<StageMemory> memory_of(const Needs& needs)
{
    const double program = kProgram + kThread * needs.threads;
    std::vector<StageMemory> stages;
    for (const RunStage& stage : all_stages()) {
        if (stage.bytes == nullptr || !stage.applies(needs)) continue;
        stages.push_back({stage.name, rounded(program + stage.bytes(needs))});
    }
    return stages;
}

std::int64_t peak_of(const Needs& needs)
{
    return std::ranges::max(memory_of(needs), {}, &StageMemory::bytes).bytes;
}

[[noreturn]] void refuse_in_blocks(const RunSize& size, std::int64_t least, std::int64_t most)
{
    throw InputError(fmt::format("{} points with {} rays need about {} of memory even in blocks, "
                                 "and --max-memory allows {}",
                                 size.read.points, size.read.rays, byte_size_text(least),
                                 byte_size_text(most)));
}

} // namespace

RunSize size_before_thinning(const SceneSize& read, const Options& options)
{
    const bool is_thinned = read.is_dense && options.thin.merge_px > 0.0;
    return {.read = read,
            .thinned = is_thinned ? SceneSize{} : read,
            .in_parts = is_thinned,
            .options = options};
}

std::vector<StageMemory> predicted_memory(const RunSize& size, int threads)
{
    return memory_of(needs_of(size, threads));
}

std::int64_t predicted_peak(const RunSize& size, int threads)
{
    return peak_of(needs_of(size, threads));
}

void require_memory(const RunSize& size, int threads, std::int64_t most)
{
    const std::int64_t needed = predicted_peak(size, threads);
    if (most <= 0 || needed <= most) return;
    throw InputError(fmt::format("{} points with {} rays need about {} of memory, and "
                                 "--max-memory allows {}",
                                 size.read.points, size.read.rays, byte_size_text(needed),
                                 byte_size_text(most)));
}

void require_memory_of(const RunSize& size, int threads)
{
    if (size.options.memory.blocks <= 0) require_memory(size, threads, size.options.memory.limit);
}

CellLimit limit_of_cells(const RunSize& size, int threads)
{
    constexpr double kSome = 1000; // few points have more cells on the hull
    constexpr double kMostOfPoint = 0x1p32;
    constexpr double kGrowing = 1.1; // with notes about a block's cells
    const std::int64_t most = size.options.memory.limit;
    if (most <= 0) return {};
    const bool in_blocks = size.options.memory.blocks > 0;
    const auto fits = [&](double cells_of_point) {
        Needs needs = needs_of(size, threads);
        needs.left.cells_of_point = cells_of_point;
        if (!in_blocks) return peak_of(needs) <= most;
        const std::int64_t left = most - least_memory(size, threads);
        return kGrowing * cgal(needs.left) <= static_cast<double>(left);
    };
    double of_point = 8; // with the points added around blocks
    for (double step = kMostOfPoint; step > 0.1; step /= 2) {
        if (fits(of_point + step)) of_point += step;
    }
    const double cells = of_point * static_cast<double>(size.thinned.points) + kSome;
    return {.limit = static_cast<std::size_t>(cells), .counts_made = !in_blocks};
}

std::int64_t predicted_scratch(const RunSize& size)
{
    const Needs n = needs_of(size, 1);
    return rounded(kScratchMargin * std::max({reading(n), filtering(n), denoising(n), cutting(n),
                                              extracting(n), cleaning(n)}));
}

std::int64_t least_memory(const RunSize& size, int threads)
{
    const double point = kHeapPoint + kHeapAddedPoint;
    return rounded(kProgram + kThread * threads + point * sizes_of(size.thinned).points);
}

BlockPlan plan_blocks(const RunSize& size, int threads, const MemoryOptions& wanted,
                      std::optional<std::int64_t> free)
{
    const bool is_open = wanted.limit == MemoryOptions::kAutoMemory;
    BlockPlan plan;
    plan.needed = predicted_peak(size, threads);
    plan.limit = is_open ? free.value_or(0) / 5 * 4 : wanted.limit;
    if (wanted.blocks == 0) {
        require_memory(size, threads, wanted.limit);
        return plan;
    }
    const bool fits = plan.limit == 0 || plan.needed <= plan.limit;
    if (wanted.blocks == MemoryOptions::kAutoBlocks && fits) return plan;

    const std::int64_t least = least_memory(size, threads);
    if (plan.limit > 0 && least >= plan.limit) refuse_in_blocks(size, least, plan.limit);
    plan.scratch = predicted_scratch(size);
    plan.blocks = wanted.blocks;
    if (wanted.blocks == MemoryOptions::kAutoBlocks) {
        const double at_once = kBlockPoint * static_cast<double>(size.thinned.points) * threads;
        const double blocks = std::ceil(at_once / (0.5 * static_cast<double>(plan.limit - least)));
        plan.blocks = static_cast<int>(std::clamp(blocks, 2.0, 65536.0));
    }
    return plan;
}

} // namespace vcarve
