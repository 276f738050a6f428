#include "steps/4_visibility/ray_weights.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "model/views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

namespace vcarve {

namespace {

using Edge = std::uint64_t; ///< smaller vertex in the upper 32 bits, larger in the lower

/// A hash of an edge. Edges whose hash is divisible by a number are a fair sample.
std::uint64_t scattered(Edge edge)
{
    edge ^= edge >> 31U;
    edge *= 0x9e3779b97f4a7c15ULL;
    edge ^= edge >> 29U;
    edge *= 0xbf58476d1ce4e5b9ULL;
    return edge ^ (edge >> 32U);
}

constexpr std::array<std::array<int, 2>, 6> kCellEdges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

void add_sampled_edges(const Cell& cell, std::uint64_t one_in, std::vector<Edge>& edges)
{
    for (const auto& [i, j] : kCellEdges) {
        const auto [low, high] = std::minmax(cell.vertices[i], cell.vertices[j]);
        const Edge edge = (static_cast<Edge>(low) << 32U) | high;
        if (high != kInfinite && scattered(edge) % one_in == 0) {
            edges.push_back(edge);
        }
    }
}

std::vector<Edge> sampled_edges(const TetMesh& mesh)
{
    // Determines the quartile to a few per mille.
    constexpr std::size_t kCellsTakenWhole = 50'000;
    const std::uint64_t one_in = 1 + mesh.cells.size() / kCellsTakenWhole;
    auto edges = parallel_collect<Edge>(mesh.cells.size(), [&](std::size_t cell, auto& found) {
        add_sampled_edges(mesh.cells[cell], one_in, found);
    });
    parallel_sort(edges);
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

double median_views(const Tracks& tracks)
{
    std::vector<double> lengths;
    for (std::size_t point = 0; point < tracks.size(); ++point) {
        if (!tracks[point].empty()) {
            lengths.push_back(static_cast<double>(tracks[point].size()));
        }
    }
    return lengths.empty() ? 1.0 : median(lengths);
}

std::vector<double> known_errors_px(const Scene& scene)
{
    std::vector<double> errors;
    std::copy_if(scene.errors_px.begin(), scene.errors_px.end(), std::back_inserter(errors),
                 [](double error) { return error >= 0.0; });
    return errors;
}

double views_weight(double views, double views_sigma)
{
    if (views_sigma == 0.0) {
        return 1.0;
    }
    const double ratio = views / views_sigma;
    return 1.0 - std::exp(-0.5 * ratio * ratio);
}

} // namespace

double short_edge_length(const TetMesh& mesh)
{
    std::vector<double> lengths;
    for (const Edge edge : sampled_edges(mesh)) {
        const auto low = static_cast<Index>(edge >> 32U);
        const auto high = static_cast<Index>(edge);
        lengths.push_back((mesh.positions[low] - mesh.positions[high]).norm());
    }
    if (lengths.empty()) {
        return 0.0;
    }
    const auto quarter = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 4);
    std::nth_element(lengths.begin(), quarter, lengths.end());
    return *quarter;
}

Scales measure_scales(const TetMesh& cells, const Scene& scene, UsualValues* usual)
{
    return {.short_edge = usual_value(usual, &UsualValues::short_edge,
                                      [&] { return short_edge_length(cells); }),
            .median_error_px = usual_value(usual, &UsualValues::median_error_px,
                                           [&] { return median(known_errors_px(scene)); }),
            .median_views = usual_value(usual, &UsualValues::median_views,
                                        [&] { return median_views(scene.tracks); }),
            .points_of_witness =
                usual_value(usual, &UsualValues::points_of_witness, [] { return 1.0; })};
}

// The median point that a view saw has full weight, so that rays in models of two-view points are
// not weak.
RayWeights::RayWeights(const Scene& scene, const Scales& scales, const TraceOptions& options)
    : scene_(scene),
      options_(options),
      median_error_px_(scales.median_error_px),
      full_(views_weight(scales.median_views, options.views_sigma))
{
}

std::int32_t RayWeights::full_weight(Index point, double weight) const
{
    weight *= by_views(scene_.tracks[point]) * by_error(scene_.errors_px[point]);
    return static_cast<std::int32_t>(std::lround(kUnit * weight));
}

/// A measured range needs no second view to confirm it, so its ray counts twice.
double RayWeights::by_views(std::span<const std::uint32_t> track) const
{
    constexpr double kOfARange = 2.0;
    if (has_measured_range(scene_, track)) {
        return kOfARange;
    }
    return views_weight(static_cast<double>(track.size()), options_.views_sigma) / full_;
}

/// Errors up to the median do not reduce the weight. An unknown error of -1 counts as 1 px.
double RayWeights::by_error(double error_px) const
{
    if (options_.error_sigma == 0.0 || median_error_px_ == 0.0) {
        return 1.0;
    }
    const double ratio = error_px / median_error_px_;
    const double beyond = std::max(0.0, ratio * ratio - 1.0);
    return std::exp(-0.5 * beyond / (options_.error_sigma * options_.error_sigma));
}

} // namespace vcarve
