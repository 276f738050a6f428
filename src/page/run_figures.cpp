#include "page/run_figures.h"

#include "geometry/triangle.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace vcarve {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kBins = 32;

/// The lengths of every edge of every face.
std::vector<double> edge_lengths(const TriMesh& mesh)
{
    std::vector<double> lengths;
    lengths.reserve(3 * mesh.faces.size());
    for (const Face& face : mesh.faces) {
        for (std::size_t i = 0; i < 3; ++i) {
            lengths.push_back((mesh.positions[face[(i + 1) % 3]] - mesh.positions[face[i]]).norm());
        }
    }
    return lengths;
}

void measure_points(SurfaceFigures& figures, const Scene& scene)
{
    std::vector<std::int64_t> track_lengths;
    std::vector<double> errors_px;
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        if (scene.kind_of(point) != PointKind::measured) continue;
        track_lengths.push_back(static_cast<std::int64_t>(scene.tracks[point].size()));
        if (scene.errors_px[point] >= 0.0) errors_px.push_back(scene.errors_px[point]);
    }
    figures.points = static_cast<std::int64_t>(track_lengths.size());
    figures.track_lengths = histogram_of_counts(std::move(track_lengths), kBins);
    figures.errors_px = histogram_of_lengths(std::move(errors_px), kBins);
}

Json histogram_json(const Histogram& histogram, const char* unit)
{
    if (histogram.values == 0) return nullptr;
    return {{"unit", unit},
            {"bounds", histogram.bounds},
            {"counts", histogram.counts},
            {"values", histogram.values},
            {"beyond", histogram.beyond},
            {"median", histogram.median},
            {"largest", histogram.largest}};
}

/// Rounds up to the next round number.
double round_step(double step)
{
    const double power = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (step <= factor * power) return factor * power;
    }
    return 10.0 * power;
}

/// The quantile at a fraction of the values. Reorders the values.
template <typename Value>
double quantile(std::vector<Value>& values, double share)
{
    const auto rank = std::min(static_cast<std::size_t>(share * static_cast<double>(values.size())),
                               values.size() - 1);
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(values.begin(), place, values.end());
    return static_cast<double>(*place);
}

template <typename Value>
void count(Histogram& histogram, std::vector<Value>& values)
{
    histogram.values = static_cast<std::int64_t>(values.size());
    histogram.median = quantile(values, 0.5);
    histogram.largest = static_cast<double>(*std::ranges::max_element(values));
    histogram.counts.assign(histogram.bounds.size() - 1, 0);
    for (const Value value : values) {
        const auto bound = std::ranges::upper_bound(histogram.bounds, static_cast<double>(value));
        if (bound == histogram.bounds.end()) {
            ++histogram.beyond;
        } else {
            ++histogram.counts[static_cast<std::size_t>(bound - histogram.bounds.begin() - 1)];
        }
    }
}

} // namespace

SurfaceFigures surface_figures(const TriMesh& mesh, std::span<const std::int32_t> supports,
                               const Scene& scene)
{
    SurfaceFigures figures;
    figures.faces = static_cast<std::int64_t>(mesh.faces.size());
    figures.edge_lengths = histogram_of_lengths(edge_lengths(mesh), kBins);
    const double too_long = SurfaceFigures::kLong * figures.edge_lengths.median;
    double all = 0.0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const double of_face = face_area(mesh.positions, mesh.faces[i]);
        all += of_face;
        if (supports[i] == 0) {
            ++figures.unsupported_faces;
            figures.unsupported_area += of_face;
        }
        if (longest_edge(mesh.positions, mesh.faces[i]) > too_long) figures.long_area += of_face;
    }
    if (all > 0.0) {
        figures.unsupported_area /= all;
        figures.long_area /= all;
    }
    measure_points(figures, scene);
    return figures;
}

Json figures_json(const SurfaceFigures& figures)
{
    return {{"points", figures.points},
            {"unsupported_faces", figures.unsupported_faces},
            {"unsupported_area", figures.unsupported_area},
            {"long_area", figures.long_area},
            {"histograms",
             {{"track_length", histogram_json(figures.track_lengths, "views")},
              {"reprojection_error", histogram_json(figures.errors_px, "px")},
              {"edge_length", histogram_json(figures.edge_lengths, "model units")}}}};
}

Histogram histogram_of_counts(std::vector<std::int64_t> values, int bins)
{
    Histogram histogram;
    if (values.empty()) return histogram;
    const auto [low, high] = std::ranges::minmax(values);
    const std::int64_t steps = std::min<std::int64_t>(bins, high - low + 1);
    for (std::int64_t i = 0; i <= steps; ++i) {
        histogram.bounds.push_back(static_cast<double>(low + i));
    }
    count(histogram, values);
    return histogram;
}

Histogram histogram_of_lengths(std::vector<double> values, int bins)
{
    Histogram histogram;
    if (values.empty()) return histogram;
    const double end = quantile(values, 0.99);
    const double step = end > 0.0 ? round_step(end / bins) : 1.0;
    const auto steps = static_cast<int>(std::floor(end / step)) + 1;
    for (int i = 0; i <= steps; ++i) {
        histogram.bounds.push_back(i * step);
    }
    count(histogram, values);
    return histogram;
}

} // namespace vcarve
