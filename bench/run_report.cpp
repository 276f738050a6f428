#include "run_report.h"

#include "pipeline/memory.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

namespace vcarve::bench {

namespace {

constexpr const char* kFigures[] = {"seconds", "cpu_seconds", "peak_bytes"};

double seconds_of(const Json& measured)
{
    return measured["seconds"].get<double>();
}

double seconds_of_stage(const Json& run, const std::string& name)
{
    const auto found = std::ranges::find_if(
        run["stages"], [&](const Json& stage) { return stage["name"] == name; });
    return found != run["stages"].end() ? seconds_of(*found) : 0.0;
}

/// The references for the rows of one thread count.
struct Bases {
    double points;
    double sequential_s;
    double parallel_s;       ///< 0 if missing
    double base_bytes = 0.0; ///< memory before the run; predictions are for the whole process
};

/// The ratio of predicted to measured memory; nothing without a prediction.
std::optional<double> predicted_share(const Json& measured, double base_bytes)
{
    if (!measured.contains("predicted_bytes")) return std::nullopt;
    return measured["predicted_bytes"].get<double>() /
           (base_bytes + measured["peak_bytes"].get<double>());
}

std::string two_digits(const std::optional<double>& number)
{
    return number ? fmt::format("{:.2f}", *number) : "-";
}

std::string row(const std::string& what, int threads, const Json& measured, const Bases& bases)
{
    const double seconds = seconds_of(measured);
    const auto peak_bytes = measured["peak_bytes"].get<double>();
    std::optional<double> parallel;
    if (bases.parallel_s > 0.0) parallel = seconds / bases.parallel_s;
    return fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.1f} | {:.0f} | {} | {:.2f} | {} |\n", what,
                       threads, seconds, measured["cpu_seconds"].get<double>(), 1e-6 * peak_bytes,
                       peak_bytes / bases.points,
                       two_digits(predicted_share(measured, bases.base_bytes)),
                       seconds / bases.sequential_s, two_digits(parallel));
}

std::string rows_of_runs(const SampleResult& result, double points)
{
    const double sequential_s = seconds_of(result.sequential);
    std::string text =
        row("CGAL alone, sequential", 1, result.sequential, {points, sequential_s, 0.0});
    for (const auto& [threads, run] : result.runs) {
        const auto parallel = result.parallel.find(threads);
        const bool has_parallel = parallel != result.parallel.end();
        const Bases bases = {points, sequential_s,
                             has_parallel ? seconds_of(parallel->second) : 0.0,
                             run["base_bytes"].get<double>()};
        if (has_parallel) text += row("CGAL alone, parallel", threads, parallel->second, bases);
        text += row("**whole run**", threads, run, bases);
        for (const Json& stage : run["stages"]) {
            text += row(stage["name"], threads, stage, bases);
        }
    }
    return text;
}

std::string verdict_on_memory(const Json& run)
{
    const double share = predicted_share(run, run["base_bytes"].get<double>()).value();
    const bool is_right = share >= kLeastPredicted && share <= kMostPredicted;
    return fmt::format("predicted peak of the process {:.0f} MB, {:.2f} x the measured one{}",
                       1e-6 * run["predicted_bytes"].get<double>(), share,
                       is_right ? ""
                                : fmt::format(" (**WARNING**: not within {} to {})",
                                              kLeastPredicted, kMostPredicted));
}

std::string summary_of_run(const SampleResult& result, int threads, const Json& run)
{
    const auto points = result.sizes["points"].get<double>();
    const double first_s = seconds_of(result.runs.begin()->second);
    const double base_cpu_s = result.sequential["cpu_seconds"].get<double>();
    return fmt::format("- on {} thread{}: {:.2f} us per point; {:.2f} x as fast as on {}; {:.2f} x "
                       "the CPU seconds of the sequential triangulation; {}\n",
                       threads, threads == 1 ? "" : "s", 1e6 * seconds_of(run) / points,
                       first_s / seconds_of(run), result.runs.begin()->first,
                       run["cpu_seconds"].get<double>() / base_cpu_s, verdict_on_memory(run));
}

} // namespace

Json median_of(const std::vector<Json>& measurements)
{
    Json result = measurements[0];
    const auto middle = [&](const auto& value_of) {
        std::vector<Json> values;
        std::ranges::transform(measurements, std::back_inserter(values), value_of);
        std::ranges::sort(values);
        return values[values.size() / 2];
    };
    for (const char* figure : kFigures) {
        if (!result.contains(figure)) continue;
        result[figure] = middle([&](const Json& one) { return one[figure]; });
        for (std::size_t i = 0; result.contains("stages") && i < result["stages"].size(); ++i) {
            result["stages"][i][figure] =
                middle([&](const Json& one) { return one["stages"][i][figure]; });
        }
    }
    return result;
}

std::string report(const SampleResult& result)
{
    const auto points = result.sizes["points"].get<double>();
    std::string text = fmt::format(
        "## {}: {} points ({} triangulated), {} rays, {} views\n\n"
        "| what | threads | seconds | CPU seconds | peak MB | bytes per point | "
        "predicted / measured | x sequential | x parallel |\n"
        "|---|---:|---:|---:|---:|---:|---:|---:|---:|\n",
        result.sizes["model"].get<std::string>(), result.sizes["points"].get<std::size_t>(),
        result.sizes["triangulated"].get<std::size_t>(), result.sizes["rays"].get<std::size_t>(),
        result.sizes["views"].get<std::size_t>());
    text += rows_of_runs(result, points) + '\n';
    for (const auto& [threads, run] : result.runs) {
        text += summary_of_run(result, threads, run);
    }
    return text;
}

std::string summary(const std::vector<SampleResult>& results)
{
    constexpr const char* kStages[] = {"fill", "triangulate", "rays", "cut", "surface"};
    std::string text = "| model | points | rays | views | threads | CGAL, s | run, s | x CGAL | "
                       "x one thread | fill | triangulate | rays | cut | surface | "
                       "bytes per point | peer, s |\n"
                       "|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
                       "---:|---:|\n";
    for (const SampleResult& result : results) {
        const auto& [threads, run] = *result.runs.rbegin();
        const auto parallel = result.parallel.find(threads);
        const double cgal_s =
            seconds_of(parallel != result.parallel.end() ? parallel->second : result.sequential);
        const std::filesystem::path model = result.sizes["model"].get<std::string>();
        const auto points = result.sizes["points"].get<std::size_t>();
        text += fmt::format(
            "| {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |",
            model.filename().string(), points, result.sizes["rays"].get<std::size_t>(),
            result.sizes["views"].get<std::size_t>(), threads, cgal_s, seconds_of(run),
            seconds_of(run) / cgal_s, seconds_of(result.runs.begin()->second) / seconds_of(run));
        for (const char* stage : kStages) {
            text += fmt::format(" {:.2f} |", seconds_of_stage(run, stage));
        }
        text += fmt::format(" {:.0f} | {} |\n",
                            run["peak_bytes"].get<double>() / static_cast<double>(points),
                            result.peer.is_null() ? "-" : two_digits(seconds_of(result.peer)));
    }
    return text;
}

Json json_of(const SampleResult& result)
{
    Json json = result.sizes;
    json["sequential_triangulation"] = result.sequential;
    json["peer"] = result.peer;
    for (const auto& [threads, measured] : result.parallel) {
        json["parallel_triangulation"][std::to_string(threads)] = measured;
    }
    for (const auto& [threads, measured] : result.runs) {
        json["runs"][std::to_string(threads)] = measured;
    }
    return json;
}

} // namespace vcarve::bench
