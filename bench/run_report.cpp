#include "run_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace vcarve::bench {

namespace {

constexpr const char* kFigures[] = {"seconds", "cpu_seconds", "peak_bytes"};

double seconds_of(const Json& measured)
{
    return measured["seconds"].get<double>();
}

/// What the rows of one number of threads are compared with.
struct Bases {
    double points;
    double sequential_s;
    double parallel_s; ///< 0 where there is none
};

std::string row(const std::string& what, int threads, const Json& measured, const Bases& bases)
{
    const double seconds = seconds_of(measured);
    const auto peak_bytes = measured["peak_bytes"].get<double>();
    const std::string parallel =
        bases.parallel_s > 0.0 ? fmt::format("{:.2f}", seconds / bases.parallel_s) : "-";
    return fmt::format("| {} | {} | {:.3f} | {:.3f} | {:.1f} | {:.0f} | {:.2f} | {} |\n", what,
                       threads, seconds, measured["cpu_seconds"].get<double>(), 1e-6 * peak_bytes,
                       peak_bytes / bases.points, seconds / bases.sequential_s, parallel);
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
                             has_parallel ? seconds_of(parallel->second) : 0.0};
        if (has_parallel) text += row("CGAL alone, parallel", threads, parallel->second, bases);
        text += row("**whole run**", threads, run, bases);
        for (const Json& stage : run["stages"]) {
            text += row(stage["name"], threads, stage, bases);
        }
    }
    return text;
}

std::string summary_of_run(const SampleResult& result, int threads, const Json& run)
{
    const auto points = result.sizes["points"].get<double>();
    const double first_s = seconds_of(result.runs.begin()->second);
    const double base_cpu_s = result.sequential["cpu_seconds"].get<double>();
    const double peak = run["base_bytes"].get<double>() + run["peak_bytes"].get<double>();
    const auto predicted = run["predicted_bytes"].get<double>();
    return fmt::format("- on {} thread{}: {:.2f} us a point; {:.2f} x as fast as on {}; {:.2f} x "
                       "the CPU seconds of the sequential triangulation; predicted peak of the "
                       "process {:.0f} MB, {:.2f} x what it was\n",
                       threads, threads == 1 ? "" : "s", 1e6 * seconds_of(run) / points,
                       first_s / seconds_of(run), result.runs.begin()->first,
                       run["cpu_seconds"].get<double>() / base_cpu_s, 1e-6 * predicted,
                       predicted / peak);
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
        "## {}: {} points ({} triangulated), {} sights, {} views\n\n"
        "| what | threads | seconds | CPU seconds | peak MB | bytes a point | x sequential | x "
        "parallel |\n|---|---:|---:|---:|---:|---:|---:|---:|\n",
        result.sizes["shape"].get<std::string>(), result.sizes["points"].get<std::size_t>(),
        result.sizes["triangulated"].get<std::size_t>(), result.sizes["sights"].get<std::size_t>(),
        result.sizes["views"].get<std::size_t>());
    text += rows_of_runs(result, points) + '\n';
    for (const auto& [threads, run] : result.runs) {
        text += summary_of_run(result, threads, run);
    }
    return text;
}

Json json_of(const SampleResult& result)
{
    Json json = result.sizes;
    json["sequential_triangulation"] = result.sequential;
    for (const auto& [threads, measured] : result.parallel) {
        json["parallel_triangulation"][std::to_string(threads)] = measured;
    }
    for (const auto& [threads, measured] : result.runs) {
        json["runs"][std::to_string(threads)] = measured;
    }
    return json;
}

} // namespace vcarve::bench
