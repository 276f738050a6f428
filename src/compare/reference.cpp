#include "compare/reference.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "compare/evidence.h"
#include "compare/truth.h"
#include "geometry/nearest_neighbors.h"
#include "geometry/triangle.h"
#include "model/extent.h"
#include "model/views.h"
#include "steps/1_points/arrange.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vcarve {

namespace {

using Box = Eigen::AlignedBox3d;

constexpr std::size_t kLeastViews = 2; ///< per point
constexpr double kMaxScaleRatio = 50.0;

/// The corners of all faces, with repetition, except faces with a corner that is not finite.
std::vector<Eigen::Vector3d> face_corners(const TriMesh& mesh)
{
    std::vector<Eigen::Vector3d> corners;
    corners.reserve(3 * mesh.faces.size());
    for (const Face& face : mesh.faces) {
        const bool finite = std::ranges::all_of(
            face, [&](std::uint32_t vertex) { return mesh.positions[vertex].allFinite(); });
        if (!finite) continue;
        for (const std::uint32_t vertex : face) {
            corners.push_back(mesh.positions[vertex]);
        }
    }
    return corners;
}

/// The text of a box in the frame of the files, so that users can compare it.
std::string box_text(const Box& box, const Eigen::Vector3d& origin)
{
    const Eigen::Vector3d low = box.min() + origin;
    const Eigen::Vector3d high = box.max() + origin;
    return fmt::format("({:.6g}, {:.6g}, {:.6g}) to ({:.6g}, {:.6g}, {:.6g})", low.x(), low.y(),
                       low.z(), high.x(), high.y(), high.z());
}

void refuse_other_frame(const NamedMesh& named, const TriMesh& placed, const Reference& reference)
{
    const std::vector<Eigen::Vector3d> corners = face_corners(placed);
    Box whole;
    for (const Eigen::Vector3d& corner : corners) {
        whole.extend(corner);
    }
    const Box points = middle_box(reference.scene.positions);
    const double mesh_size = middle_box(corners).diagonal().norm();
    const double model_size = points.diagonal().norm();
    const bool same_scale =
        mesh_size <= kMaxScaleRatio * model_size && model_size <= kMaxScaleRatio * mesh_size;
    // The points of a flat scene span no box, so a mesh within a diagonal of them is accepted.
    const Eigen::Vector3d margin = Eigen::Vector3d::Constant(model_size);
    const bool same_place = whole.intersects(Box(points.min() - margin, points.max() + margin));
    if (same_place && same_scale) return;
    throw InputError(fmt::format(
        "{}: the mesh is in another frame than the model: its box is {}, but "
        "most points of the model are in {}",
        named.name, box_text(whole, reference.origin), box_text(points, reference.origin)));
}

/// All views, and the finite points with enough views or a measured range.
Scene countable_part(const Scene& model)
{
    Scene scene;
    scene.cameras = model.cameras;
    scene.views = model.views;
    scene.offset = model.offset;
    for (std::size_t point = 0; point < model.num_points(); ++point) {
        const auto track = model.tracks[point];
        if (!model.positions[point].allFinite()) continue;
        if (track.size() < kLeastViews && !has_measured_range(model, track)) continue;
        scene.positions.push_back(model.positions[point]);
        scene.tracks.push_back(track);
    }
    return scene;
}

constexpr std::size_t kNeighbor = 6;
constexpr double kLeastShareOfMedian = 0.01;

/// The sum of the areas of faces 0 to i, for each i. A face that is not finite counts 0.
std::vector<double> cumulated_areas(const TriMesh& mesh)
{
    std::vector<double> ends;
    ends.reserve(mesh.faces.size());
    double sum = 0.0;
    for (const Face& face : mesh.faces) {
        const double area = face_area(mesh.positions, face);
        sum += std::isfinite(area) ? area : 0.0;
        ends.push_back(sum);
    }
    return ends;
}

/// Maps two uniform numbers to a uniform sample of a triangle (Osada et al. 2002).
Eigen::Vector3d point_in_face(const TriMesh& mesh, const Face& face, double u, double v)
{
    const double root = std::sqrt(u);
    return (1.0 - root) * mesh.positions[face[0]] + root * (1.0 - v) * mesh.positions[face[1]] +
           root * v * mesh.positions[face[2]];
}

} // namespace

std::uint64_t stream_seed(const CompareOptions& options, RandomStream stream)
{
    return (static_cast<std::uint64_t>(options.seed) << 8U) + static_cast<std::uint64_t>(stream);
}

bool is_hidden(const Eigen::Vector3d& place, const Eigen::Vector3d& eye, const TriangleTree& by,
               double skip)
{
    const Eigen::Vector3d line = eye - place;
    const double length = line.norm();
    return length > skip && by.is_met(place + line * (skip / length), eye);
}

std::vector<double> distances_to(const TriangleTree& surface,
                                 std::span<const Eigen::Vector3d> places)
{
    std::vector<double> distances(places.size());
    parallel_for(
        places.size(), [&](std::size_t i) { distances[i] = surface.distance(places[i]); }, 64);
    return distances;
}

TriMesh in_frame(TriMesh mesh, const Eigen::Vector3d& origin)
{
    const Eigen::Vector3d shift = mesh.offset - origin;
    for (Eigen::Vector3d& position : mesh.positions) {
        position += shift;
    }
    mesh.offset = origin;
    return mesh;
}

MeasuredMesh place_mesh(const NamedMesh& named, const Reference& reference)
{
    if (named.mesh.faces.empty()) {
        throw InputError(fmt::format("{}: the file has {} vertices but no faces, so there is no "
                                     "surface to measure",
                                     named.name, named.mesh.positions.size()));
    }
    TriMesh placed;
    placed.faces = named.mesh.faces;
    placed.positions = named.mesh.positions;
    placed.offset = named.mesh.offset;
    placed = in_frame(std::move(placed), reference.origin);
    TriangleTree tree(placed);
    if (tree.is_empty()) {
        throw InputError(fmt::format("{}: none of the {} faces has an area, so there is no surface "
                                     "to measure",
                                     named.name, placed.faces.size()));
    }
    refuse_other_frame(named, placed, reference);
    return {std::move(placed), std::move(tree)};
}

Reference make_reference(const Scene& model, const NamedMesh* truth, const CompareOptions& options)
{
    Reference reference;
    reference.options = options;
    reference.scene = center_points(countable_part(model));
    const std::size_t points = reference.scene.num_points();
    if (points < 2) {
        throw InputError(fmt::format("the model has {} points with two or more views, but a "
                                     "comparison needs at least two such points",
                                     points));
    }
    reference.origin = reference.scene.offset;
    reference.spacings = point_spacings(reference.scene.positions);
    reference.median_spacing = median(reference.spacings);
    reference.rays = view_rays(reference.scene, options);
    if (truth != nullptr) {
        reference.truth = seen_truth(*truth, reference);
    }
    return reference;
}

std::vector<double> point_spacings(const std::vector<Eigen::Vector3d>& points)
{
    const Neighborhoods nearest = nearest_neighborhoods(points, kNeighbor);
    std::vector<double> spacings(points.size());
    for (std::size_t i = 0; i < spacings.size(); ++i) {
        spacings[i] = std::sqrt(nearest.reach_sq(i));
    }
    const double least = kLeastShareOfMedian * median(spacings);
    for (double& spacing : spacings) {
        spacing = std::max(spacing, least);
    }
    return spacings;
}

SurfaceSamples sample_surface(const TriMesh& mesh, std::size_t count, std::uint64_t seed)
{
    const std::vector<double> ends = cumulated_areas(mesh);
    SurfaceSamples samples;
    if (ends.empty() || ends.back() <= 0.0) return samples;
    samples.positions.resize(count);
    samples.faces.resize(count);
    const double step = ends.back() / static_cast<double>(count);
    parallel_for(count, [&](std::size_t i) {
        // Find the face that contains this sample's part of the area.
        const double area = (static_cast<double>(i) + random_number(seed, 3 * i)) * step;
        auto end = std::upper_bound(ends.begin(), ends.end(), area);
        if (end == ends.end()) end = std::lower_bound(ends.begin(), ends.end(), ends.back());
        const auto face = static_cast<std::size_t>(end - ends.begin());
        // Take a random position on it.
        const double u = random_number(seed, 3 * i + 1);
        const double v = random_number(seed, 3 * i + 2);
        samples.positions[i] = point_in_face(mesh, mesh.faces[face], u, v);
        samples.faces[i] = static_cast<std::uint32_t>(face);
    });
    return samples;
}

} // namespace vcarve
