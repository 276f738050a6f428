// Times the five operations of table 1 of Akgunduz, Zetu, Banerjee, "Viewpoint-centered shape
// recovery from multiple views" (2000), on one thread. Usage: time_paper MOST_POINTS. The object
// has the paper's number of points, and 100, 1000, ... up to MOST_POINTS. Writes JSON to standard
// output: medians and minima over runs, in seconds.
#include "figures/paper_case.h"
#include "figures/timed_object.h"
#include "mesh/half_edge_mesh.h"
#include "model/visibility_energy.h"
#include "run_program.h"
#include "steps/3_cells/triangulate.h"
#include "steps/4_visibility/count_crossings.h"
#include "steps/5_labels/label_cells.h"
#include "steps/6_surface/carve_surface.h"
#include "steps/6_surface/cleanup.h"
#include "steps/6_surface/provenance.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

namespace vcarve::paper {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kViewpoints[] = {7, 10, 15, 23}; // as in the paper's table

/// The object with a number of viewpoints, and the inputs of each operation.
struct Case {
    Scene scene;
    const TetMesh* cells = nullptr; ///< the same for all viewpoints
    RaySource source;
    Crossings crossings;
    Labels labels;
    CleanSurface surface;
};

struct Operation {
    const char* name;
    void (*run)(const Case&);
};

constexpr Operation kOperations[] = {
    {"delaunay", [](const Case& c) { vcarve::triangulate(c.scene); }},
    {"check",
     [](const Case& c) {
         Crossings counted;
         CrossingCounter(*c.cells).cast(c.source, counted, {});
     }},
    {"tetrahedra", [](const Case& c) { carve(*c.cells, c.crossings, 1); }},
    {"hidden", [](const Case& c) { extract_surface(*c.cells, c.labels, c.scene); }},
    {"normals", [](const Case& c) { view_agreement(*c.surface.mesh, c.scene); }},
};

Case make_case(Scene scene, const TetMesh& cells)
{
    Case made;
    made.cells = &cells;
    made.crossings = crossings_of(cells, scene);
    made.labels = carve(cells, made.crossings, 1);
    made.surface = clean_surface(extract_surface(cells, made.labels, scene),
                                 {.min_component = 0, .max_hole = 0});
    made.scene = std::move(scene);
    return made;
}

double seconds_of(const Operation& operation, const Case& on)
{
    const auto start = std::chrono::steady_clock::now();
    operation.run(on);
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
    return taken.count();
}

/// The seconds of each operation on each case. Each round runs all of them, so other load on the
/// machine affects all equally.
std::vector<std::vector<std::vector<double>>> timed(const std::vector<Case>& cases)
{
    constexpr std::size_t kLeastRounds = 5;
    constexpr std::size_t kMostRounds = 5000;
    constexpr double kEnoughSeconds = 10.0;
    std::vector<std::vector<std::vector<double>>> all(
        cases.size(), std::vector<std::vector<double>>(std::size(kOperations)));
    double sum = 0.0;
    for (std::size_t round = 0; // the first round has cold caches and is ignored
         round <= kLeastRounds || (sum < kEnoughSeconds && round <= kMostRounds); ++round) {
        for (std::size_t i = 0; i < cases.size(); ++i) {
            for (std::size_t k = 0; k < std::size(kOperations); ++k) {
                const double seconds = seconds_of(kOperations[k], cases[i]);
                if (round == 0) continue;
                all[i][k].push_back(seconds);
                sum += seconds;
            }
        }
    }
    return all;
}

Json summary(std::vector<double> seconds)
{
    std::ranges::sort(seconds);
    return {{"median", seconds[seconds.size() / 2]},
            {"least", seconds.front()},
            {"runs", seconds.size()}};
}

Json row_of(const Case& measured, const std::vector<std::vector<double>>& seconds)
{
    Json row = {{"points", measured.scene.num_points()},
                {"viewpoints", measured.scene.views.size()},
                {"rays", measured.scene.num_rays()},
                {"cells", measured.cells->cells.size()},
                {"inside", std::ranges::count(measured.labels, Label::inside)},
                {"faces", measured.surface.counts.faces}};
    for (std::size_t k = 0; k < std::size(kOperations); ++k) {
        row["seconds"][kOperations[k].name] = summary(seconds[k]);
    }
    return row;
}

/// Adds a row for each number of viewpoints.
void measure(std::size_t points, Json& rows)
{
    const TetMesh cells = vcarve::triangulate(timed_object(points, 1));
    std::vector<Case> cases;
    for (const std::size_t viewpoints : kViewpoints) {
        cases.push_back(make_case(timed_object(points, viewpoints), cells));
        fmt::print(stderr, "time_paper: {} points, {} viewpoints\n", points, viewpoints);
    }
    for (Case& made : cases) {
        made.source = photographs(made.scene); // keeps a reference to this scene
    }
    const auto seconds = timed(cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        rows.push_back(row_of(cases[i], seconds[i]));
    }
}

Json measure_all(std::size_t most_points)
{
    Json rows = Json::array();
    measure(kPapersPoints, rows);
    for (std::size_t points = 100; points <= most_points; points *= 10) {
        measure(points, rows);
    }
    return rows;
}

} // namespace

} // namespace vcarve::paper

int main(int argc, char** argv)
{
    return vcarve::run_program(
        std::span(argv, static_cast<std::size_t>(argc)), "time_paper MOST_POINTS", 1, 1,
        [](std::span<char*> words) {
            const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
            fmt::print("{}\n", vcarve::paper::measure_all(std::stoul(words[0])).dump());
        });
}
