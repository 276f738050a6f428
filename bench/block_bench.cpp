#include "block_bench.h"

#include "io/colmap/colmap_model.h"
#include "io/colmap/find_model.h"
#include "program_run.h"
#include "run_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::bench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInMemory = "0";

/// 0 where that only shows when it is read.
std::size_t points_of(const fs::path& model)
{
    try {
        const FoundModel found = find_model(model);
        const auto size = size_before_reading(found.folder, found.format);
        return size ? size->points : 0;
    } catch (const std::exception&) {
        return 0; // a scan, say
    }
}

/// Runs the program once and leaves its surface in `out`.
Json measure_once(const fs::path& model, const BlockRuns& runs, const BlockRun& run,
                  const fs::path& out)
{
    const fs::path work = runs.folder / "work";
    fs::remove_all(work);
    std::vector<std::string> words = {
        runs.program, "--quiet", "--threads", std::to_string(run.threads), "--blocks", run.blocks};
    if (run.blocks != kInMemory) words.insert(words.end(), {"--work", work});
    words.insert(words.end(), {model, out});
    Json figures = measure_program(words, work);
    fs::remove_all(work);
    return figures;
}

std::vector<BlockRun> wanted_runs(const BlockRuns& runs)
{
    std::vector<BlockRun> wanted;
    for (const int threads : runs.threads) {
        const auto add = [&](const std::string& blocks) {
            wanted.push_back({.blocks = blocks, .threads = threads, .figures = {}});
        };
        if (runs.in_memory) add(kInMemory);
        std::ranges::for_each(runs.blocks, add);
    }
    return wanted;
}

/// The figure beside that of the run in memory; "-" where there is none.
std::string beside(const BlockRun& run, const BlockResult& result, const char* name)
{
    const auto base = std::ranges::find_if(result.runs, [&](const BlockRun& other) {
        return other.blocks == kInMemory && other.threads == run.threads;
    });
    if (base == result.runs.end()) return "-";
    return fmt::format("{:.2f}",
                       run.figures[name].get<double>() / base->figures[name].get<double>());
}

std::string name_of(BlockRun::Surface surface)
{
    if (surface == BlockRun::Surface::unknown) return "-";
    return surface == BlockRun::Surface::same ? "yes" : "**NO**";
}

std::string row(const BlockRun& run, const BlockResult& result)
{
    const Json& figures = run.figures;
    const auto points = static_cast<double>(result.points);
    return fmt::format(
        "| {} | {} | {:.2f} | {} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n",
        run.blocks == kInMemory ? "in memory" : run.blocks, run.threads,
        figures["seconds"].get<double>(), beside(run, result, "seconds"),
        figures["cpu_seconds"].get<double>(), megabytes(figures, "peak_bytes"),
        beside(run, result, "peak_bytes"),
        points > 0.0 ? fmt::format("{:.0f}", figures["peak_bytes"].get<double>() / points) : "-",
        megabytes(figures, "scratch_bytes"), megabytes(figures, "written_bytes"),
        megabytes(figures, "read_bytes"), name_of(run.surface));
}

} // namespace

BlockResult measure_blocks(const std::filesystem::path& model, const BlockRuns& runs)
{
    fs::create_directories(runs.folder);
    const fs::path first = runs.folder / "first.ply";
    const fs::path other = runs.folder / "other.ply";
    BlockResult result = {model.filename().string(), points_of(model), wanted_runs(runs)};
    std::vector<std::vector<Json>> measured(result.runs.size());
    for (std::size_t round = 0; round < runs.rounds; ++round) {
        for (std::size_t i = 0; i < result.runs.size(); ++i) {
            BlockRun& run = result.runs[i];
            const bool is_first = round == 0 && i == 0;
            measured[i].push_back(measure_once(model, runs, run, is_first ? first : other));
            if (is_first || run.surface == BlockRun::Surface::other) continue;
            run.surface =
                have_same_bytes(first, other) ? BlockRun::Surface::same : BlockRun::Surface::other;
        }
    }
    for (std::size_t i = 0; i < result.runs.size(); ++i) {
        result.runs[i].figures = median_of(measured[i]);
    }
    return result;
}

std::string block_report(const BlockResult& result)
{
    std::string text = fmt::format(
        "## {}: {} points\n\n"
        "| blocks | threads | seconds | x in memory | CPU seconds | peak MB | x in memory "
        "| bytes a point | scratch MB | written MB | read MB | same bytes |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
        result.model, result.points > 0 ? std::to_string(result.points) : "?");
    for (const BlockRun& run : result.runs) {
        text += row(run, result);
    }
    return text;
}

bool is_same_everywhere(const BlockResult& result)
{
    return std::ranges::none_of(
        result.runs, [](const BlockRun& run) { return run.surface == BlockRun::Surface::other; });
}

Json json_of(const BlockResult& result)
{
    Json json = {{"model", result.model}, {"points", result.points}, {"runs", Json::array()}};
    for (const BlockRun& run : result.runs) {
        Json entry = {{"blocks", run.blocks},
                      {"threads", run.threads},
                      {"same_bytes", run.surface != BlockRun::Surface::other}};
        entry.update(run.figures);
        json["runs"].push_back(std::move(entry));
    }
    return json;
}

} // namespace vcarve::bench
