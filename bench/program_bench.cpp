#include "program_bench.h"

#include "io/colmap/colmap_model.h"
#include "io/colmap/find_model.h"
#include "io/files/mapped_file.h"
#include "run_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::bench {

namespace {

namespace fs = std::filesystem;

constexpr const char* kInMemory = "0";
constexpr const char* kTile = "100000"; // points

/// A run of a program. Its surface must be byte-identical to that of run `like`.
struct Run {
    std::vector<std::string> words; ///< the command line without the output file
    std::size_t like = 0;
    Json figures = {}; ///< of measure_program(): medians over the rounds
    bool is_same = true;
};

fs::path work_of(const Programs& programs)
{
    return programs.folder / "work";
}

void measure(std::vector<Run>& runs, const Programs& programs)
{
    fs::create_directories(programs.folder);
    const auto surface = [&](std::size_t i) { return programs.folder / fmt::format("{}.ply", i); };
    std::vector<std::vector<Json>> measured(runs.size());
    for (std::size_t round = 0; round < programs.rounds; ++round) {
        for (std::size_t i = 0; i < runs.size(); ++i) {
            fs::remove_all(work_of(programs));
            std::vector<std::string> words = runs[i].words;
            words.push_back(surface(i));
            measured[i].push_back(measure_program(words, work_of(programs)));
            const MappedFile mine(surface(i));
            const MappedFile wanted(surface(runs[i].like));
            if (!std::ranges::equal(mine.bytes(), wanted.bytes())) runs[i].is_same = false;
        }
    }
    fs::remove_all(work_of(programs));
    for (std::size_t i = 0; i < runs.size(); ++i) {
        runs[i].figures = median_of(measured[i]);
    }
}

double figure(const Run& run, const char* name)
{
    return run.figures[name].get<double>();
}

std::string megabytes(const Run& run, const char* name)
{
    return fmt::format("{:.0f}", 1e-6 * figure(run, name));
}

const char* yes_or_no(bool is_same)
{
    return is_same ? "yes" : "**NO**";
}

/// The number of points of a model; 0 if it is unknown before the model is read.
std::size_t points_of(const fs::path& model)
{
    try {
        const FoundModel found = find_model(model);
        const auto size = size_before_reading(found.folder, found.format);
        return size ? size->points : 0;
    } catch (const std::exception&) {
        return 0; // for example a scan
    }
}

} // namespace

ProgramReport compare_blocks(const fs::path& model, const std::vector<std::string>& blocks,
                             const std::vector<int>& threads, const Programs& programs)
{
    std::vector<Run> runs;
    for (const int count : threads) {
        for (const std::string& word : blocks) {
            Run& run = runs.emplace_back(Run{{programs.program, "--quiet", "--threads",
                                              std::to_string(count), "--blocks", word}});
            if (word != kInMemory) run.words.insert(run.words.end(), {"--work", work_of(programs)});
            run.words.push_back(model);
        }
    }
    measure(runs, programs);
    const std::size_t points = points_of(model);
    const std::string name = model.filename().string();
    ProgramReport report;
    report.figures = {{"model", name}, {"points", points}, {"runs", Json::array()}};
    report.table = fmt::format(
        "## {}: {} points\n\n"
        "| blocks | threads | seconds | x in memory | CPU seconds | peak MB | x in memory "
        "| bytes per point | scratch MB | written MB | read MB | same bytes |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
        name, points > 0 ? std::to_string(points) : "?");
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const Run& run = runs[i];
        const std::string& word = blocks[i % blocks.size()];
        const int count = threads[i / blocks.size()];
        const Run& first = runs[i - i % blocks.size()]; // with the same thread count
        const auto beside = [&](const char* of) {
            return blocks[0] == kInMemory
                       ? fmt::format("{:.2f}", figure(run, of) / figure(first, of))
                       : "-";
        };
        report.table += fmt::format(
            "| {} | {} | {:.2f} | {} | {:.2f} | {} | {} | {} | {} | {} | {} | {} |\n",
            word == kInMemory ? "in memory" : word, count, figure(run, "seconds"),
            beside("seconds"), figure(run, "cpu_seconds"), megabytes(run, "peak_bytes"),
            beside("peak_bytes"),
            points > 0
                ? fmt::format("{:.0f}", figure(run, "peak_bytes") / static_cast<double>(points))
                : "-",
            megabytes(run, "scratch_bytes"), megabytes(run, "written_bytes"),
            megabytes(run, "read_bytes"), yes_or_no(run.is_same));
        Json entry = {{"blocks", word}, {"threads", count}, {"same_bytes", run.is_same}};
        entry.update(run.figures);
        report.figures["runs"].push_back(std::move(entry));
        report.is_same = report.is_same && run.is_same;
    }
    return report;
}

ProgramReport compare_ranks(const std::string& title, const std::vector<RankModel>& models,
                            const Programs& programs)
{
    std::vector<Run> runs; // two per model: one process, and ranks
    for (const RankModel& model : models) {
        runs.push_back(
            {{programs.program, "--quiet", "--threads", "1", "--tile-points", kTile, model.folder},
             runs.size()});
        runs.push_back({{"mpirun", "-q", "--oversubscribe", "--bind-to", "none", "-n",
                         std::to_string(model.ranks), programs.rank_program, "--quiet", "--threads",
                         "1", "--tile-points", kTile, "--work", work_of(programs), model.folder},
                        runs.size() - 1});
    }
    measure(runs, programs);
    ProgramReport report;
    report.figures = {{"model", title}, {"runs", Json::array()}};
    report.table = fmt::format(
        "## {}\n\n"
        "| ranks | points | seconds | CPU seconds | CPU us per point | efficiency, CPU "
        "| efficiency, elapsed | CPU us per point, one process | x one process | largest peak MB "
        "| written MB | same bytes |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
        title);
    const auto cpu_s_a_point = [&](std::size_t i) {
        const std::size_t model = i / 2; // two runs per model
        return figure(runs[i], "cpu_seconds") / static_cast<double>(models[model].points);
    };
    const auto seconds_a_share = [&](std::size_t i) {
        const RankModel& model = models[i / 2];
        return figure(runs[i], "seconds") * static_cast<double>(model.ranks) /
               static_cast<double>(model.points);
    };
    for (std::size_t i = 1; i < runs.size(); i += 2) {
        const RankModel& model = models[i / 2];
        const bool is_same = runs[i - 1].is_same && runs[i].is_same;
        report.table += fmt::format(
            "| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {} | {} | "
            "{} |\n",
            model.ranks, model.points, figure(runs[i], "seconds"), figure(runs[i], "cpu_seconds"),
            1e6 * cpu_s_a_point(i), cpu_s_a_point(1) / cpu_s_a_point(i),
            seconds_a_share(1) / seconds_a_share(i), 1e6 * cpu_s_a_point(i - 1),
            cpu_s_a_point(i) / cpu_s_a_point(i - 1), megabytes(runs[i], "peak_bytes"),
            megabytes(runs[i], "written_bytes"), yes_or_no(is_same));
        report.figures["runs"].push_back({{"ranks", model.ranks},
                                          {"points", model.points},
                                          {"on_ranks", runs[i].figures},
                                          {"alone", runs[i - 1].figures},
                                          {"same_bytes", is_same}});
        report.is_same = report.is_same && is_same;
    }
    return report;
}

} // namespace vcarve::bench
