#include "page/run_figures.h"

#include <algorithm>
#include <array>

namespace vcarve {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kBins = 32;

std::array<double, 3> edge_lengths(const TriMesh& mesh, const Face& face)
{
    const auto length = [&](int from, int to) {
        return (mesh.positions[face[to]] - mesh.positions[face[from]]).norm();
    };
    return {length(0, 1), length(1, 2), length(2, 0)};
}

double area(const TriMesh& mesh, const Face& face)
{
    const Eigen::Vector3d& corner = mesh.positions[face[0]];
    return 0.5 * (mesh.positions[face[1]] - corner).cross(mesh.positions[face[2]] - corner).norm();
}

void measure_points(SurfaceFigures& figures, const Scene& scene)
{
    std::vector<std::int64_t> track_lengths(scene.num_points());
    std::vector<double> errors_px;
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        track_lengths[point] = static_cast<std::int64_t>(scene.tracks[point].size());
        if (scene.errors_px[point] >= 0.0) errors_px.push_back(scene.errors_px[point]);
    }
    figures.points = static_cast<std::int64_t>(scene.num_points());
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

} // namespace

SurfaceFigures surface_figures(const TriMesh& mesh, std::span<const std::int32_t> supports,
                               const Scene& scene)
{
    SurfaceFigures figures;
    figures.faces = static_cast<std::int64_t>(mesh.faces.size());
    std::vector<double> lengths;
    lengths.reserve(3 * mesh.faces.size());
    for (const Face& face : mesh.faces) {
        std::ranges::copy(edge_lengths(mesh, face), std::back_inserter(lengths));
    }
    figures.edge_lengths = histogram_of_lengths(lengths, kBins);
    const double too_long = SurfaceFigures::kLong * figures.edge_lengths.median;
    double all = 0.0;
    for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
        const double of_face = area(mesh, mesh.faces[i]);
        all += of_face;
        if (supports[i] == 0) {
            ++figures.unsupported_faces;
            figures.unsupported_area += of_face;
        }
        const auto* const edges = lengths.data() + 3 * i;
        if (std::max({edges[0], edges[1], edges[2]}) > too_long) figures.long_area += of_face;
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

} // namespace vcarve
