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
        stages.push_back(
            {stage.name, rounded(program + stage.bytes(needs)), stage.part == Part::dense});
    }
    return stages;
}

StageMemory peak_of(const Needs& needs)
{
    return std::ranges::max(memory_of(needs), {}, &StageMemory::bytes);
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
    return peak_of(needs_of(size, threads)).bytes;
}

void require_memory(const RunSize& size, int threads, std::int64_t most)
{
    const auto [stage, needed, is_stereo] = peak_of(needs_of(size, threads));
    if (most <= 0 || needed <= most) return;
    if (is_stereo) {
        throw InputError(fmt::format("--dense needs about {} of memory for {} photographs, but the "
                                     "limit is {}; use a smaller --dense-size, fewer --threads, or "
                                     "a larger --max-memory",
                                     byte_size_text(needed), size.photos.size(),
                                     byte_size_text(most)));
    }
    throw InputError(fmt::format("{} points with {} rays need about {} of memory, and "
                                 "--max-memory allows {}",
                                 size.read.points, size.read.rays, byte_size_text(needed),
                                 byte_size_text(most)));
}

std::size_t most_cells(const RunSize& size, int threads)
{
    constexpr double kSome = 1000; // few points have more cells on the hull
    constexpr double kMostOfPoint = 0x1p32;
    const std::int64_t most = size.options.memory.limit;
    if (most <= 0) return kAnyCells;
    const auto fits = [&](double cells_of_point) {
        Needs needs = needs_of(size, threads);
        needs.left.cells_of_point = cells_of_point;
        return peak_of(needs).bytes <= most;
    };
    double of_point = 8; // with the points added around blocks
    for (double step = kMostOfPoint; step > 0.1; step /= 2) {
        if (fits(of_point + step)) of_point += step;
    }
    return static_cast<std::size_t>(of_point * static_cast<double>(size.thinned.points) + kSome);
}

} // namespace vcarve
