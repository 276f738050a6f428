// Measures whole runs, from files to files, against CGAL's triangulation of the same points:
// seconds, CPU seconds and peak memory per stage. See tools/bench.

#include "measurements.h"
#include "processes.h"
#include "run_report.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <map>

namespace vcarve::bench {

namespace {

struct Arguments {
    std::filesystem::path folder;              ///< for models and surfaces
    std::vector<std::filesystem::path> models; ///< to measure
    std::vector<std::string> shapes = {"surface"};
    std::vector<double> noise_along = {SampleKind().noise_along};
    std::vector<double> noise_across; ///< empty: the same as along
    std::vector<double> outliers = {SampleKind().outliers};
    bool clustered = false;
    std::size_t views = SampleKind().views;
    std::vector<std::uint64_t>
        points;                 ///< of samples; empty: default sizes, or no samples with models
    std::filesystem::path peer; ///< empty disables it
    std::vector<int> threads = {1, 2};
    std::size_t rounds = 3;
    std::filesystem::path json; ///< empty: write no file
};

using Rounds = std::map<int, std::vector<Json>>; ///< measurements by thread count

std::map<int, Json> medians_of(const Rounds& rounds)
{
    std::map<int, Json> medians;
    for (const auto& [threads, measured] : rounds) {
        medians[threads] = median_of(measured);
    }
    return medians;
}

/// Each round runs all measurements in turn, so other load on the machine affects all equally.
SampleResult measure(const Sample& sample, const Arguments& arguments)
{
    std::vector<Json> sequential;
    std::vector<Json> peer;
    Rounds parallel;
    Rounds runs;
    const auto measure_all = [&](int threads) {
        if (threads > 1) {
            parallel[threads].push_back(
                in_own_process([&] { return measure_parallel_triangulation(sample, threads); }));
        }
        runs[threads].push_back(in_own_process([&] { return measure_run(sample, threads); }));
    };
    for (std::size_t round = 0; round < arguments.rounds; ++round) {
        sequential.push_back(
            in_own_process([&] { return measure_sequential_triangulation(sample); }));
        std::ranges::for_each(arguments.threads, measure_all);
        if (arguments.peer.empty()) continue;
        peer.push_back(
            measure_program({arguments.peer, sample.model, sample.scratch / "peer.ply"}));
    }
    return {.sizes = {},
            .sequential = median_of(sequential),
            .peer = peer.empty() ? Json() : median_of(peer),
            .parallel = medians_of(parallel),
            .runs = medians_of(runs)};
}

std::string load_line()
{
    std::array<double, 3> loads{};
    const bool known = ::getloadavg(loads.data(), 3) == 3;
    return fmt::format("System load at the start: {:.1f}.", known ? loads[0] : -1.0);
}

std::string machine_line()
{
    return load_line() + " Peaks are above the memory at the start of the measurement. \"predicted "
                         "/ measured\" is for the whole process. \"x sequential\" and \"x "
                         "parallel\" are relative to CGAL's triangulation alone.";
}

/// All combinations of shapes, noise and shares of outliers.
std::vector<SampleKind> kinds(const Arguments& arguments)
{
    std::vector<SampleKind> result;
    const auto add = [&](SampleKind kind, double along) {
        kind.noise_along = along;
        const std::vector<double> as_along = {along};
        for (const double across :
             arguments.noise_across.empty() ? as_along : arguments.noise_across) {
            kind.noise_across = across;
            for (const double outliers : arguments.outliers) {
                kind.outliers = outliers;
                result.push_back(kind);
            }
        }
    };
    for (const std::string& shape : arguments.shapes) {
        for (const double along : arguments.noise_along) {
            add({.shape = shape_named(shape),
                 .clustered = arguments.clustered,
                 .views = arguments.views},
                along);
        }
    }
    return result;
}

std::vector<std::uint64_t> sizes(const Arguments& arguments)
{
    if (!arguments.points.empty()) return arguments.points;
    return {10'000, 100'000};
}

/// Makes a model with this number of points.
Sample made_sample(const Arguments& arguments, const SampleKind& kind, std::uint64_t points)
{
    const auto folder = arguments.folder / fmt::format("{}_{}", name_of(kind), points);
    in_own_process([&] {
        make_model(folder, kind, points);
        return Json();
    });
    return {folder, folder};
}

/// The given models, and samples with the requested numbers of points.
std::vector<Sample> samples(const Arguments& arguments)
{
    std::vector<Sample> result;
    for (const std::filesystem::path& model : arguments.models) {
        result.push_back({model, arguments.folder / std::to_string(result.size())});
    }
    if (!result.empty() && arguments.points.empty()) return result;
    for (const SampleKind& kind : kinds(arguments)) {
        for (const std::uint64_t points : sizes(arguments)) {
            result.push_back(made_sample(arguments, kind, points));
        }
    }
    return result;
}

void write_json(const std::filesystem::path& path, const Json& record)
{
    if (!path.empty()) std::ofstream(path) << record.dump(2) << '\n';
}

void run(const Arguments& arguments)
{
    fmt::print("{}\n\n", machine_line());
    Json record = Json::array();
    std::vector<SampleResult> results;
    for (const Sample& sample : samples(arguments)) {
        const Json sizes = in_own_process([&] { return prepare(sample); });
        SampleResult result = measure(sample, arguments);
        result.sizes = sizes;
        fmt::print("{}\n", report(result));
        std::fflush(stdout);
        record.push_back(json_of(result));
        results.push_back(std::move(result));
    }
    if (results.size() > 1) fmt::print("{}", summary(results));
    write_json(arguments.json, record);
}

void add_sample_options(CLI::App& app, Arguments& arguments)
{
    app.add_option("--model", arguments.models,
                   "models or dense workspaces; add --points for samples")
        ->check(CLI::ExistingDirectory);
    app.add_option("--shape", arguments.shapes, "surface,terrain,hall,wide")->delimiter(',');
    app.add_option("--views", arguments.views,
                   "views of a sample; 100, or 300 from a million points on");
    app.add_option("--noise", arguments.noise_along,
                   "noise of points along their rays, in point spacings: .1,.25,.5,1")
        ->delimiter(',')
        ->check(CLI::NonNegativeNumber);
    app.add_option("--noise-across", arguments.noise_across,
                   "noise across the rays; default: as along")
        ->delimiter(',')
        ->check(CLI::NonNegativeNumber);
    app.add_option("--outliers", arguments.outliers, "share of outliers: 0,.02,.1")
        ->delimiter(',')
        ->check(CLI::Range(0.0, 1.0));
    app.add_flag("--clustered", arguments.clustered, "vary the density by up to 256 times");
    app.add_option("--points", arguments.points, "numbers of points: 10k,1M")
        ->delimiter(',')
        ->transform(CLI::AsNumberWithUnit(
            std::map<std::string, std::uint64_t>{{"k", 1'000}, {"M", 1'000'000}}));
}

} // namespace

} // namespace vcarve::bench

int main(int count, char** words)
{
    try {
        vcarve::bench::Arguments arguments;
        CLI::App app("Measure colmap-vcarve on models and samples.");
        app.add_option("--folder", arguments.folder, "the folder of models; missing ones are made")
            ->required();
        vcarve::bench::add_sample_options(app, arguments);
        app.add_option("--peer", arguments.peer,
                       "run another program in turn, as PROGRAM MODEL OUT.ply")
            ->check(CLI::ExistingFile);
        app.add_option("--threads", arguments.threads, "thread counts: 1,2")->delimiter(',');
        app.add_option("--rounds", arguments.rounds, "number of rounds; medians are printed")
            ->check(CLI::PositiveNumber);
        app.add_option("--json", arguments.json, "write all figures to this file");
        CLI11_PARSE(app, count, words);
        vcarve::bench::run(arguments);
        return 0;
    } catch (const std::exception& error) {
        fmt::print(stderr, "vcarve_run_bench: {}\n", error.what());
        return 1;
    }
}
