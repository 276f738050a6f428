#include "compare/worst_places.h"

#include "compare/evidence.h"
#include "compare/truth.h"
#include "geometry/triangle.h"
#include "model/extent.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

namespace vcarve {
namespace {

constexpr std::size_t kSamples = 100000;
constexpr double kCellShare = 0.02;  ///< of the diagonal
constexpr double kApartShare = 0.08; ///< of the diagonal

/// The samples in one cube of the grid.
struct Lump {
    double sum = 0.0;
    std::size_t worst = 0; ///< its farthest sample
};

/// The index of a cube along one axis, clamped to what doubles resolve.
std::int64_t cube_of(double coordinate, double cell)
{
    constexpr double kMost = 1e15;
    return static_cast<std::int64_t>(std::floor(std::clamp(coordinate / cell, -kMost, kMost)));
}

/// The cubes with a sample farther than choice.least, worst first.
std::vector<Lump> lumps_of(std::span<const Eigen::Vector3d> samples,
                           std::span<const double> distances, const WorstChoice& choice)
{
    std::map<std::tuple<std::int64_t, std::int64_t, std::int64_t>, Lump> cubes;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (!(distances[i] > choice.least)) continue;
        const Eigen::Vector3d& place = samples[i];
        Lump& lump =
            cubes
                .try_emplace({cube_of(place.x(), choice.cell), cube_of(place.y(), choice.cell),
                              cube_of(place.z(), choice.cell)},
                             Lump{0.0, i})
                .first->second;
        lump.sum += distances[i];
        if (distances[i] > distances[lump.worst]) lump.worst = i;
    }
    std::vector<Lump> lumps;
    lumps.reserve(cubes.size());
    for (const auto& cube : cubes) {
        lumps.push_back(cube.second);
    }
    std::ranges::sort(lumps, [](const Lump& a, const Lump& b) {
        return a.sum > b.sum || (a.sum == b.sum && a.worst < b.worst);
    });
    return lumps;
}

/// Options for positions and distances in diagonals.
WorstChoice choice_of(std::size_t count)
{
    return {.cell = kCellShare, .apart = kApartShare, .least = kTolerances.front(), .count = count};
}

/// The worst samples. `samples` are in the reference's frame, `distances` in diagonals.
std::vector<std::size_t> worst_of(std::vector<Eigen::Vector3d> samples,
                                  std::span<const double> distances, const Reference& reference,
                                  std::size_t count)
{
    const double diagonal = diagonal_of(reference);
    for (Eigen::Vector3d& sample : samples) {
        sample /= diagonal;
    }
    return worst_samples(samples, distances, choice_of(count));
}

void divide(std::vector<double>& lengths, double unit)
{
    for (double& length : lengths) {
        length /= unit;
    }
}

/// Sets the viewpoint of a position on a mesh: the view that sees its face most frontally, or the
/// direction of the normal if no view sees it.
void look_at(WorstPlace& place, const Eigen::Vector3d& normal, const MeasuredMesh& mesh,
             const Reference& reference)
{
    place.towards = normal;
    place.views = 0;
    double squarest = -1.0;
    for (const View& view : reference.scene.views) {
        if (!view_sees(view, place.position, mesh, reference)) continue;
        ++*place.views;
        const Eigen::Vector3d line = view.center - place.position;
        const double square = std::abs(normal.dot(line.normalized()));
        if (square <= squarest) continue;
        squarest = square;
        place.towards = line.normalized();
        place.reach = line.norm();
    }
}

} // namespace

std::vector<std::size_t> worst_samples(std::span<const Eigen::Vector3d> samples,
                                       std::span<const double> distances, const WorstChoice& choice)
{
    std::vector<std::size_t> named;
    for (const Lump& lump : lumps_of(samples, distances, choice)) {
        if (named.size() == choice.count) break;
        const bool is_near = std::ranges::any_of(named, [&](std::size_t other) {
            const double lone =
                std::max(choice.apart, std::min(distances[lump.worst], distances[other]));
            return (samples[lump.worst] - samples[other]).norm() < lone;
        });
        if (!is_near) named.push_back(lump.worst);
    }
    return named;
}

double diagonal_of(const Reference& reference)
{
    if (reference.truth) return reference.truth->diagonal;
    const std::vector<Eigen::Vector3d>& points = reference.scene.positions;
    const double of_most = middle_box(points).diagonal().norm();
    if (of_most > 0.0) return of_most;
    const double of_all = middle_box(points, 0.0).diagonal().norm();
    return of_all > 0.0 ? of_all : 1.0;
}

SurfaceDistances surface_distances(const MeasuredMesh& mesh, const TriangleTree& other,
                                   const Reference& reference)
{
    const auto most = static_cast<std::size_t>(reference.options.samples);
    const std::uint64_t seed = stream_seed(reference.options, RandomStream::place);
    SurfaceDistances far;
    far.samples = sample_surface(mesh.mesh, std::min(kSamples, most), seed);
    far.distances = distances_to(other, far.samples.positions);
    divide(far.distances, diagonal_of(reference));
    return far;
}

std::vector<WorstPlace> largest_deviations(const MeasuredMesh& mesh, const SurfaceDistances& far,
                                           const Reference& reference, std::size_t count)
{
    std::vector<WorstPlace> places;
    for (const std::size_t i : worst_of(far.samples.positions, far.distances, reference, count)) {
        WorstPlace place{.position = far.samples.positions[i], .distance = far.distances[i]};
        const Face& face = mesh.mesh.faces[far.samples.faces[i]];
        look_at(place, face_normal(mesh.mesh.positions, face), mesh, reference);
        places.push_back(place);
    }
    return places;
}

std::vector<WorstPlace> largest_gaps(const MeasuredMesh& mesh, const Reference& reference,
                                     std::size_t count)
{
    // The truth's samples are sorted by face, so every n-th sample is spread like all.
    const Truth& truth = *reference.truth;
    const std::size_t step = truth.samples.size() / kSamples + 1;
    std::vector<Eigen::Vector3d> samples;
    for (std::size_t i = 0; i < truth.samples.size(); i += step) {
        samples.push_back(truth.samples[i]);
    }
    std::vector<double> distances = distances_to(mesh.tree, samples);
    divide(distances, truth.diagonal);
    std::vector<WorstPlace> places;
    for (const std::size_t i : worst_of(samples, distances, reference, count)) {
        const bool in_image = truth.image_views[i * step] != kNoView;
        const std::uint32_t view = (in_image ? truth.image_views : truth.views)[i * step];
        const Eigen::Vector3d line = reference.scene.views[view].center - samples[i];
        WorstPlace place{samples[i], distances[i], line.normalized(), line.norm()};
        if (!in_image) place.views = 0;
        places.push_back(place);
    }
    return places;
}

} // namespace vcarve
