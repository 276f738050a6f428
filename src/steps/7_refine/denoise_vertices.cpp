#include "base/arrays.h"
#include "base/numbers.h"
#include "base/parallel.h"
#include "base/statistics.h"
#include "geometry/bilateral_filter.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "model/camera.h"
#include "model/views.h"
#include "steps/7_refine/refine.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

using Vectors = std::vector<Vector3d>; ///< one per vertex

template <typename Value>
Vectors of_vertices(const HalfEdgeMesh& mesh, const Value& value)
{
    Vectors values(mesh.n_vertices());
    parallel_for(values.size(),
                 [&](std::size_t v) { values[v] = value(handle_at<VertexHandle>(v)); });
    return values;
}

/// The vertices adjacent to a vertex, and those across its opposite edges; ascending.
void collect_around(const HalfEdgeMesh& mesh, VertexHandle vertex,
                    std::vector<std::uint32_t>& around)
{
    around.clear();
    for (const auto out : mesh.voh_range(vertex)) {
        around.push_back(static_cast<std::uint32_t>(index(out.to())));
        if (out.is_boundary()) continue;
        const auto across = out.next().opp();
        if (across.is_boundary()) continue;
        around.push_back(static_cast<std::uint32_t>(index(across.next().to())));
    }
    sort_unique(around);
    std::erase(around, static_cast<std::uint32_t>(index(vertex)));
}

Neighborhoods ring_neighborhoods(const HalfEdgeMesh& mesh, const Vectors& positions,
                                 const Progress& progress)
{
    constexpr std::size_t kMost = 16;
    Neighborhoods neighborhoods(positions.size(), kMost);
    parallel_for_ranges(positions.size(), progress, [&](std::size_t first, std::size_t last) {
        std::vector<std::uint32_t> around;
        for (std::size_t v = first; v < last; ++v) {
            const auto distance_sq = [&](std::uint32_t other) {
                return (positions[other] - positions[v]).squaredNorm();
            };
            const auto is_nearer = [&](std::uint32_t one, std::uint32_t other) {
                return std::pair(distance_sq(one), one) < std::pair(distance_sq(other), other);
            };
            collect_around(mesh, handle_at<VertexHandle>(v), around);
            if (around.size() > kMost) {
                std::ranges::nth_element(around, around.begin() + kMost, is_nearer);
                around.resize(kMost);
            }
            double reach_sq = 0.0;
            for (const std::uint32_t other : around) {
                reach_sq = std::max(reach_sq, distance_sq(other));
            }
            neighborhoods.set(v, around, reach_sq);
        }
    });
    return neighborhoods;
}

bool knows_errors(const Scene& scene)
{
    return std::ranges::any_of(scene.errors_px, [](double error) { return error >= 0.0; });
}

bool knows_error(const Scene& scene, std::size_t point)
{
    return scene.errors_px[point] >= 0.0 && scene.kind_of(point) == PointKind::measured;
}

/// The standard deviation of the image positions, in pixels, from the reprojection errors.
double noise_of_errors_px(const Scene& scene)
{
    constexpr double kUnknown = -1.0;
    return median_of_some(scene.num_points(), [&](std::size_t point) {
        const auto coordinates = 2.0 * static_cast<double>(scene.tracks[point].size());
        if (!knows_error(scene, point) || coordinates <= 3.0) return kUnknown;
        return scene.errors_px[point] * std::sqrt(coordinates / (coordinates - 3.0)) /
               std::sqrt(std::numbers::pi / 2.0);
    });
}

/// Whether the points are free of noise, as in synthetic models: more than one vertex in 20 is
/// coplanar with its neighbors.
bool is_exact(const HalfEdgeMesh& mesh)
{
    constexpr std::size_t kOneIn = 20;
    constexpr double kFlat = 1.0 - 1e-9; // cosine
    const auto is_flat = [&](VertexHandle vertex) {
        const Vector3d normal = vertex_normal(mesh, vertex); // zero if the vertex has no faces
        for (const FaceHandle face : mesh.vf_range(vertex)) {
            const auto [a, b, c] = mesh.triangle(face);
            if (!(scaled_normal(a, b, c).normalized().dot(normal) > kFlat)) return false;
        }
        return !normal.isZero(0.0);
    };
    const auto flat =
        parallel_collect<std::size_t>(mesh.n_vertices(), [&](std::size_t v, auto& found) {
            const auto vertex = handle_at<VertexHandle>(v);
            if (!mesh.is_deleted(vertex) && is_flat(vertex)) found.push_back(v);
        });
    return kOneIn * flat.size() > mesh.n_vertices();
}

/// An upper bound of the noise, before heights above the surface are known.
double most_noise_px(const HalfEdgeMesh& mesh, const Scene& scene)
{
    if (knows_errors(scene)) return noise_of_errors_px(scene);
    return is_exact(mesh) ? 0.0 : kUnlimited;
}

/// Whether displacements turn a face too far.
bool is_turned_by(const HalfEdgeMesh& mesh, const Vectors& displacements, FaceHandle face)
{
    if (mesh.is_deleted(face)) return false;
    const std::array<Vector3d, 3> before = mesh.triangle(face);
    std::array<Vector3d, 3> after = before;
    std::size_t i = 0;
    for (const VertexHandle corner : mesh.corners(face)) {
        after[i++] += displacements[index(corner)];
    }
    return after != before && turns_too_far(before, after);
}

using Faces = std::vector<FaceHandle>;

/// The faces among `count` that turn too far, in the same order.
template <typename FaceAt>
Faces turning(const HalfEdgeMesh& mesh, const Vectors& displacements, std::size_t count,
              const FaceAt& face_at)
{
    return parallel_collect<FaceHandle>(count, [&](std::size_t i, Faces& faces) {
        if (is_turned_by(mesh, displacements, face_at(i))) faces.push_back(face_at(i));
    });
}

/// Halves or cancels displacements until no face turns too far. Returns how many it limits.
std::int64_t hold_back(const HalfEdgeMesh& mesh, Vectors& displacements)
{
    constexpr std::uint8_t kHalvings = 2; // then the vertex stays
    std::vector<std::uint8_t> halvings(displacements.size());
    Faces turned = turning(mesh, displacements, mesh.n_faces(),
                           [](std::size_t i) { return handle_at<FaceHandle>(i); });
    while (!turned.empty()) {
        std::vector<VertexHandle> held;
        for (const FaceHandle face : turned) {
            for (const VertexHandle corner : mesh.corners(face)) {
                if (!displacements[index(corner)].isZero(0.0)) held.push_back(corner);
            }
        }
        sort_unique(held);
        Faces around;
        for (const VertexHandle vertex : held) {
            const bool continues = halvings[index(vertex)]++ < kHalvings;
            displacements[index(vertex)] *= continues ? 0.5 : 0.0;
            for (const auto face : mesh.vf_range(vertex)) {
                around.push_back(face);
            }
        }
        sort_unique(around);
        turned =
            turning(mesh, displacements, around.size(), [&](std::size_t i) { return around[i]; });
    }
    return static_cast<std::int64_t>(halvings.size()) - std::ranges::count(halvings, 0);
}

std::uint32_t point_of(const HalfEdgeMesh& mesh, std::size_t v)
{
    return mesh.data(handle_at<VertexHandle>(v)).scene_point;
}

BilateralFilter filter_of(const HalfEdgeMesh& mesh, const Vectors& positions, const Scene& scene,
                          const Progress& progress)
{
    Neighborhoods neighborhoods = ring_neighborhoods(mesh, positions, progress);
    const Vectors normals =
        of_vertices(mesh, [&](VertexHandle v) { return vertex_normal(mesh, v); });
    Vectors filtered = filtered_normals(positions, normals, neighborhoods);
    const std::vector<double> focals_px = mean_focals_px(scene.cameras);
    return {positions, std::move(filtered), std::move(neighborhoods),
            [&](std::size_t v) -> Eigen::Matrix3d {
                const std::uint32_t point = point_of(mesh, v);
                if (point == kNoPoint) return Eigen::Matrix3d::Zero();
                return covariance_of_a_pixel(scene, point, focals_px);
            }};
}

/// Whether a vertex is a measured point off the boundary, with a known error if any is known.
bool may_move(const HalfEdgeMesh& mesh, const Scene& scene, std::size_t v, bool with_errors)
{
    const auto vertex = handle_at<VertexHandle>(v);
    const std::uint32_t point = point_of(mesh, v);
    return !mesh.is_deleted(vertex) && !mesh.is_boundary(vertex) && point != kNoPoint &&
           (with_errors ? knows_error(scene, point) : scene.kind_of(point) == PointKind::measured);
}

/// The displacements of the movable vertices to their filtered positions.
Vectors ways_to_surface(const HalfEdgeMesh& mesh, const Scene& scene, const BilateralFilter& filter,
                        double gate, const Progress& progress)
{
    constexpr double kMost = 0.25; // of the spacing
    Vectors displacements(mesh.n_vertices(), Vector3d::Zero());
    const std::vector<double> spacings = vertex_spacings(mesh);
    const bool with_errors = knows_errors(scene);
    parallel_for(displacements.size(), progress, [&](std::size_t v) {
        if (!may_move(mesh, scene, v, with_errors)) return;
        const Vector3d way = filter.estimate(v, gate) - mesh.point(handle_at<VertexHandle>(v));
        const double most = kMost * spacings[v];
        displacements[v] = way.norm() > most ? Vector3d(way * (most / way.norm())) : way;
    });
    return displacements;
}

} // namespace

DenoiseVerticesCounts denoise_vertices(HalfEdgeMesh& mesh, const Scene& scene,
                                       const DenoiseOptions& options, const Progress& progress,
                                       UsualValues* usual)
{
    DenoiseVerticesCounts counts;
    counts.vertices = num_vertices_left(mesh);
    counts.noise_px = most_noise_px(mesh, scene);
    if (!(options.denoise * counts.noise_px > 0.0)) return counts;
    const Vectors positions = of_vertices(mesh, [&](VertexHandle v) { return mesh.point(v); });
    const BilateralFilter filter = filter_of(mesh, positions, scene, progress.part(0.0, 0.5));
    counts.noise_px = usual_value(usual, &UsualValues::vertex_noise_px,
                                  [&] { return std::min(counts.noise_px, filter.noise_px()); });
    const double gate = options.denoise * counts.noise_px;
    if (!(gate > 0.0)) return counts;
    Vectors displacements = ways_to_surface(mesh, scene, filter, gate, progress.part(0.6, 0.9));
    counts.held = hold_back(mesh, displacements);
    for (const VertexHandle vertex : mesh.vertices()) {
        const Vector3d& way = displacements[index(vertex)];
        if (way.isZero(0.0)) continue;
        mesh.set_point(vertex, mesh.point(vertex) + way);
        ++counts.moved;
    }
    set_vertex_normals(mesh);
    return counts;
}

} // namespace vcarve
