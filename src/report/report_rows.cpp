#include "report/report_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace vcarve {
namespace {

std::string share(double value)
{
    return fmt::format("{:.4f}", value);
}

Row count_row(const char* title, std::int64_t MeshCheck::*member)
{
    return {title, [member](const Comparison& c) { return fmt::format("{}", c.size.*member); }};
}

std::vector<Row> size_rows()
{
    return {
        count_row("vertices", &MeshCheck::vertices),
        count_row("faces", &MeshCheck::faces),
        {"area", [](const Comparison& c) { return fmt::format("{:.5g}", c.size.area); }},
        count_row("components", &MeshCheck::components),
        count_row("boundary edges", &MeshCheck::boundary_edges),
        count_row("non-manifold edges", &MeshCheck::nonmanifold_edges),
        count_row("non-manifold vertices", &MeshCheck::nonmanifold_vertices),
        count_row("orientation faults", &MeshCheck::orientation_faults),
        count_row("degenerate faces", &MeshCheck::degenerate_faces),
        count_row("unreferenced vertices", &MeshCheck::unreferenced_vertices),
        {"genus",
         [](const Comparison& c) { return c.genus ? fmt::format("{}", *c.genus) : "open"; }},
    };
}

Row evidence_row(const char* title, double EvidenceFigures::*member)
{
    return {title, [member](const Comparison& c) { return share(c.evidence.*member); }};
}

std::vector<Row> evidence_rows()
{
    return {
        evidence_row("hidden sights", &EvidenceFigures::hidden_sights),
        evidence_row("missed points", &EvidenceFigures::missed_points),
        evidence_row("unsupported area", &EvidenceFigures::unsupported_area),
        evidence_row("median distance [spacings]", &EvidenceFigures::median_distance),
        {"seen boundary edges",
         [](const Comparison& c) { return fmt::format("{}", c.evidence.seen_boundary_edges); }},
        {"back faces seen",
         [](const Comparison& c) {
             return c.evidence.rays ? share(c.evidence.rays->back_faces_seen) : "-";
         }},
        {"nothing seen",
         [](const Comparison& c) {
             const std::optional<RayFigures>& rays = c.evidence.rays;
             return rays && rays->nothing_seen ? share(*rays->nothing_seen) : "-";
         }},
    };
}

Row truth_row(std::string title, std::function<double(const TruthFigures&)> figure)
{
    return {std::move(title), [figure = std::move(figure)](const Comparison& c) {
                return c.truth ? share(figure(*c.truth)) : "-";
            }};
}

Row line_row(const char* title, double LineFigures::*member)
{
    return {title, [member](const Comparison& c) {
                return c.truth && c.truth->lines ? share((*c.truth->lines).*member) : "-";
            }};
}

std::vector<Row> truth_rows()
{
    std::vector<Row> rows;
    for (std::size_t i = 0; i < kTolerances.size(); ++i) {
        const std::string at = fmt::format(" {} %", 100.0 * kTolerances[i]);
        rows.push_back(truth_row("F" + at, [i](const auto& t) { return t.agreements[i].f_score; }));
        rows.push_back(
            truth_row("precision" + at, [i](const auto& t) { return t.agreements[i].precision; }));
        rows.push_back(
            truth_row("recall" + at, [i](const auto& t) { return t.agreements[i].recall; }));
    }
    rows.push_back(
        truth_row("mean accuracy [%]", [](const auto& t) { return 100.0 * t.mean_accuracy; }));
    rows.push_back(truth_row("mean completeness [%]",
                             [](const auto& t) { return 100.0 * t.mean_completeness; }));
    rows.push_back(truth_row("blocked", [](const auto& t) { return t.blocked; }));
    rows.push_back(line_row("seen right", &LineFigures::seen_right));
    rows.push_back(line_row("torn", &LineFigures::torn));
    rows.push_back(line_row("open", &LineFigures::open));
    return rows;
}

Row cost_row(const char* title, std::function<std::string(const RunCost&)> figure)
{
    return {title, [figure = std::move(figure)](const Comparison& c) {
                return c.cost ? figure(*c.cost) : "-";
            }};
}

std::vector<Row> cost_rows()
{
    return {
        cost_row("seconds", [](const auto& cost) { return fmt::format("{:.2f}", cost.seconds); }),
        cost_row("CPU seconds",
                 [](const auto& cost) { return fmt::format("{:.2f}", cost.cpu_seconds); }),
        cost_row("peak memory [MB]",
                 [](const auto& cost) {
                     return fmt::format("{:.1f}",
                                        static_cast<double>(cost.peak_memory_bytes) / 1e6);
                 }),
    };
}

void append(std::vector<Row>& rows, std::vector<Row> more)
{
    std::ranges::move(more, std::back_inserter(rows));
}

} // namespace

bool has_costs(std::span<const Comparison> comparisons)
{
    return std::ranges::any_of(comparisons,
                               [](const Comparison& c) { return c.cost || !c.failure.empty(); });
}

std::vector<Row> report_rows(std::span<const Comparison> comparisons, bool with_truth)
{
    std::vector<Row> rows = size_rows();
    append(rows, evidence_rows());
    if (with_truth) append(rows, truth_rows());
    if (has_costs(comparisons)) append(rows, cost_rows());
    return rows;
}

} // namespace vcarve
