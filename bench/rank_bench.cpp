#include "rank_bench.h"

#include "program_run.h"
#include "run_report.h"

#include <fmt/format.h>

#include <algorithm>

namespace vcarve::bench {

namespace {

namespace fs = std::filesystem;

/// A number of a run's figures.
double figure(const Json& figures, const char* name)
{
    return figures[name].get<double>();
}

double cpu_per_point(const RankRun& run)
{
    return figure(run.figures, "cpu_seconds") / static_cast<double>(run.model.points);
}

double points_per_rank(const RankRun& run)
{
    return static_cast<double>(run.model.points) / static_cast<double>(run.model.ranks);
}

double seconds_per_share(const RankRun& run)
{
    return figure(run.figures, "seconds") / points_per_rank(run);
}

/// Runs a model on its ranks and leaves its surface in `out`.
Json measure_on_ranks(const RankModel& model, const RankRuns& runs, const fs::path& out)
{
    const fs::path work = runs.folder / "work";
    fs::remove_all(work);
    Json figures = measure_program({runs.launcher, "-q", "--oversubscribe", "--bind-to", "none",
                                    "-n", std::to_string(model.ranks), runs.rank_program, "--quiet",
                                    "--threads", "1", "--work", work, model.folder, out},
                                   work);
    fs::remove_all(work);
    return figures;
}

Json measure_alone(const RankModel& model, const RankRuns& runs, const fs::path& out)
{
    return measure_program(
        {runs.program, "--quiet", "--threads", "1", "--blocks", "0", model.folder, out},
        runs.folder / "work");
}

std::string row(const RankRun& run, const RankRun& first)
{
    const auto points = static_cast<double>(run.model.points);
    return fmt::format("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} | "
                       "{} | {} | {} |\n",
                       run.model.ranks, run.model.points, figure(run.figures, "seconds"),
                       figure(run.figures, "cpu_seconds"), 1e6 * cpu_per_point(run),
                       cpu_per_point(first) / cpu_per_point(run),
                       seconds_per_share(first) / seconds_per_share(run),
                       1e6 * figure(run.alone, "cpu_seconds") / points,
                       figure(run.figures, "cpu_seconds") / figure(run.alone, "cpu_seconds"),
                       megabytes(run.figures, "peak_bytes"),
                       megabytes(run.figures, "written_bytes"), run.is_same ? "yes" : "**NO**");
}

} // namespace

std::vector<RankRun> measure_ranks(const std::vector<RankModel>& models, const RankRuns& runs)
{
    fs::create_directories(runs.folder);
    const fs::path on_ranks = runs.folder / "ranks.ply";
    const fs::path alone = runs.folder / "alone.ply";
    std::vector<RankRun> results;
    results.reserve(models.size());
    for (const RankModel& model : models) {
        results.push_back({.model = model, .figures = {}, .alone = {}});
    }
    std::vector<std::vector<Json>> of_ranks(models.size());
    std::vector<std::vector<Json>> of_one(models.size());
    for (std::size_t round = 0; round < runs.rounds; ++round) {
        for (std::size_t i = 0; i < models.size(); ++i) {
            of_ranks[i].push_back(measure_on_ranks(models[i], runs, on_ranks));
            of_one[i].push_back(measure_alone(models[i], runs, alone));
            results[i].is_same = results[i].is_same && have_same_bytes(on_ranks, alone);
        }
    }
    for (std::size_t i = 0; i < models.size(); ++i) {
        results[i].figures = median_of(of_ranks[i]);
        results[i].alone = median_of(of_one[i]);
    }
    return results;
}

std::string rank_report(const std::string& title, const std::vector<RankRun>& runs)
{
    std::string text = fmt::format(
        "## {}\n\n"
        "| ranks | points | seconds | CPU seconds | CPU us a point | efficiency, CPU "
        "| efficiency, elapsed | CPU us a point, one process | x one process | largest peak MB "
        "| written MB | same bytes |\n"
        "|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---|\n",
        title);
    for (const RankRun& run : runs) {
        text += row(run, runs.front());
    }
    return text;
}

bool is_same_everywhere(const std::vector<RankRun>& runs)
{
    return std::ranges::all_of(runs, &RankRun::is_same);
}

Json json_of(const std::vector<RankRun>& runs)
{
    Json json = Json::array();
    for (const RankRun& run : runs) {
        json.push_back({{"ranks", run.model.ranks},
                        {"points", run.model.points},
                        {"on_ranks", run.figures},
                        {"alone", run.alone},
                        {"same_bytes", run.is_same}});
    }
    return json;
}

} // namespace vcarve::bench
