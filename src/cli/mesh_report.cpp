#include "cli/mesh_report.h"

#include "base/stage_counts.h"
#include "base/text.h"
#include "io/files/output_file.h"
#include "mesh/check.h"
#include "page/page.h"
#include "page/page_scene.h"
#include "steps/4_visibility/face_visibility.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <stdexcept>
#include <tuple>
#include <utility>
#include <vector>

namespace vcarve::cli {

namespace {

Json check_json(const MeshCheck& check)
{
    return {{"vertices", check.vertices},
            {"faces", check.faces},
            {"degenerate_faces", check.degenerate_faces},
            {"components", check.components},
            {"boundary_edges", check.boundary_edges},
            {"nonmanifold_edges", check.nonmanifold_edges},
            {"nonmanifold_vertices", check.nonmanifold_vertices},
            {"orientation_faults", check.orientation_faults},
            {"unreferenced_vertices", check.unreferenced_vertices},
            {"euler_characteristic", check.euler_characteristic},
            {"area", check.area},
            {"is_closed", check.is_closed()},
            {"is_manifold", check.is_manifold()}};
}

/// A count of a stage; 0 of 0 if it is missing.
Count count_of(const CountsOfStages& stages, const char* stage, const CountKind& kind)
{
    const auto counts = stages.find(stage);
    const Count* found = counts == stages.end() ? nullptr : find_count(counts->second, kind);
    return found == nullptr ? Count{kind, 0, 0} : *found;
}

std::string percent(double share)
{
    return fmt::format("{} %", std::llround(100.0 * share));
}

std::string openness_text(const RunOutcome& outcome, const SurfaceOptions& options)
{
    constexpr double kShown = 0.005; // of all pixels; rounds to 1 %
    if (outcome.boundary_edges == 0) return "closed";
    if (!outcome.open)
        return fmt::format("{} boundary edges", grouped_digits(outcome.boundary_edges));
    std::string text = "no visible holes";
    if (*outcome.open >= kShown) {
        text =
            fmt::format("holes in {} of the visible surface (to close: {})", percent(*outcome.open),
                        options.rules.max_closing != 0.0 ? "--max-closing 0" : "--closed");
    } else if (*outcome.open > 0.0) {
        text = "holes in less than 1 % of the visible surface";
    }
    if (outcome.past >= kShown)
        text += fmt::format("; {} of the pixels show sky or surfaces without points",
                            percent(outcome.past));
    return text;
}

void propose_for_points(const RunOutcome& outcome, const FilterOptions& options,
                        std::vector<std::string>& proposals)
{
    constexpr double kMany = 0.2;
    constexpr std::int64_t kFew = 500;
    const bool is_nearest = outcome.takes_nearest_views;
    std::vector<std::pair<std::int64_t, const char*>> losses = {
        {is_nearest && options.min_views < 2 ? 0 : outcome.few_views,
         options.min_views > 2   ? "a smaller --min-views"
         : options.min_views < 2 ? "--rays nearest"
         : is_nearest            ? "--min-views 1"
                                 : "--min-views 1 or --rays nearest"},
        {outcome.high_error, "a larger --max-error"},
        {outcome.low_angle, "a smaller --min-angle"},
        {outcome.stray, "a larger --stray-spacing"}};
    std::ranges::stable_sort(losses, std::greater(), [](const auto& loss) { return loss.first; });
    for (const auto& [dropped, remedy] : losses) {
        const double share = static_cast<double>(dropped) /
                             static_cast<double>(std::max<std::int64_t>(outcome.points_before, 1));
        if (share < kMany) break;
        proposals.push_back(fmt::format(
            "if parts are missing, try {}: {} of the points were dropped", remedy, percent(share)));
    }
    if (proposals.empty() && outcome.points < kFew && !outcome.is_dense) {
        proposals.push_back(fmt::format("only {}; add images, or use a dense cloud",
                                        counted(outcome.points, "points")));
    }
}

void propose_for_surface(const RunOutcome& outcome, const Options& options,
                         std::vector<std::string>& proposals)
{
    constexpr double kMuchLong = 0.6;
    if (outcome.long_area < kMuchLong) return;
    if (options.surface.closed) {
        proposals.emplace_back("if large faces are in the way, leave out --closed");
    } else if (options.crop.region.kind == RegionChoice::Kind::everything) {
        proposals.emplace_back("if large faces are in the way, try --crop auto");
    }
}

} // namespace

ReportParts make_report(const ReportedRun& made, Log& log)
{
    const auto& [mesh, scene] = std::tie(made.mesh, made.scene);
    Stage stage(log, "report");
    ReportParts parts;
    parts.figures = surface_figures(mesh, face_supports(mesh, scene), scene);
    parts.scene = packed_scene(scene);
    Json surface = packed_surface(mesh, scene, {}, stage);
    const auto faces = surface["faces"]["count"].get<std::int64_t>();
    // If the mesh was simplified for the page, its texture does not fit.
    if (faces == parts.figures.faces) surface["texture"] = packed_texture(made.texture);
    parts.scene["surfaces"][0] = std::move(surface);
    parts.scene["removed"] = packed_removed(made.removed);
    parts.scene["depth"] = packed_depth(made.depth, scene);
    stage.end({{counts::kOutput.faces_shown, faces, parts.figures.faces}});
    return parts;
}

Json report_json(const ReportParts& parts, const Json& record)
{
    Json json = figures_json(parts.figures);
    json["warnings"] = warnings_of(parts.figures, record);
    return json;
}

void write_report(const std::filesystem::path& path, const Json& record, const ReportParts& parts)
{
    OutputFile file(path);
    write_page(file.stream(), record, parts.scene);
    file.commit();
}

Json checked(const TriMesh& mesh, const CountsOfStages& counts, Log& log)
{
    Stage stage(log, "check");
    Json json = check_json(check_mesh(mesh));
    json["self_intersections"] = count_self_intersections(mesh);
    Counts told = {{counts::kOutput.open_edges, json["boundary_edges"]},
                   {counts::kOutput.crossing, json["self_intersections"]}};
    if (counts.contains("orient")) {
        const Count outside = count_of(counts, "orient", counts::kMesh.outside);
        told.push_back({counts::kOutput.behind, outside.of - outside.value, outside.of});
    }
    stage.end(told);
    return json;
}

void require_promised(const Json& surface, const std::string& command, const std::string& model)
{
    for (const char* const fault :
         {"nonmanifold_edges", "nonmanifold_vertices", "orientation_faults", "degenerate_faces"}) {
        if (surface[fault] == 0) continue;
        throw std::logic_error(fmt::format("the mesh has {} {} and was not written; the command "
                                           "was {}, the model {}",
                                           surface[fault].dump(), fault, command, model));
    }
}

std::int64_t bare_faces(const CountsOfStages& counts)
{
    return count_of(counts, "texture", counts::kTexture.bare).value;
}

RunOutcome outcome_of(const CountsOfStages& counts, RunOutcome outcome)
{
    outcome.faces = count_of(counts, "write", counts::kOutput.faces).value;
    outcome.boundary_edges = count_of(counts, "orient", counts::kMesh.boundary_edges).value +
                             count_of(counts, "join", counts::kJoin.boundary_edges).value;
    const Count open = count_of(counts, "open", counts::kMesh.open);
    if (const auto rays = static_cast<double>(open.of); rays > 0.0) {
        outcome.open = static_cast<double>(open.value) / rays;
        outcome.past =
            static_cast<double>(count_of(counts, "open", counts::kMesh.past).value) / rays;
    }
    const auto dropped = [&](const CountKind& kind) {
        return count_of(counts, "filter", kind).value;
    };
    const Count kept = count_of(counts, "filter", counts::kFilter.points);
    const std::int64_t in_tiles = count_of(counts, "plan", counts::kPlan.points).value;
    outcome.points = kept.value + in_tiles; // losses in tiles are unknown
    outcome.points_before = kept.of + in_tiles;
    outcome.few_views = dropped(counts::kFilter.few_views);
    outcome.high_error = dropped(counts::kFilter.high_error);
    outcome.low_angle = dropped(counts::kFilter.low_angle);
    outcome.stray = dropped(counts::kFilter.stray);
    return outcome;
}

std::string closing_line(const RunOutcome& outcome, const Options& options)
{
    constexpr std::size_t kMost = 2;
    constexpr std::size_t kLineColumns = 80;
    std::vector<std::string> proposals;
    propose_for_points(outcome, options.points, proposals);
    propose_for_surface(outcome, options, proposals);
    std::string line = fmt::format("wrote {}: {}, {}", outcome.out, counted(outcome.faces, "faces"),
                                   openness_text(outcome, options.surface));
    if (proposals.empty() && !outcome.has_report) {
        const auto page = std::filesystem::path(outcome.out).replace_extension(".html");
        const std::string see = fmt::format("See it: --report {}", page.string());
        line += (line.size() + 2 + see.size() <= kLineColumns ? ". " : "\n") + see;
    }
    for (std::size_t i = 0; i < std::min(proposals.size(), kMost); ++i) {
        line += "\n" + proposals[i];
    }
    return line;
}

} // namespace vcarve::cli
