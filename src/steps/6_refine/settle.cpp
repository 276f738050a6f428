#include "steps/6_refine/settle.h"

#include "base/median_of_some.h"
#include "base/parallel.h"
#include "geometry/bilateral_filter.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "model/camera.h"
#include "model/pixel_covariance.h"

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

using Vectors = std::vector<Vector3d>; ///< one a vertex

template <typename Value>
Vectors of_vertices(const HalfEdgeMesh& mesh, const Value& value)
{
    Vectors values(mesh.n_vertices());
    parallel_for(values.size(),
                 [&](std::size_t v) { values[v] = value(handle_at<VertexHandle>(v)); });
    return values;
}

template <typename Item>
void sort_unique(std::vector<Item>& items)
{
    std::sort(items.begin(), items.end());
    items.erase(std::unique(items.begin(), items.end()), items.end());
}

/// The vertices beside a vertex, and those across the edges opposite to it; ascending.
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

/// Whether a point was found in images.
bool is_matched(const Scene& scene, std::size_t point)
{
    return scene.errors_px[point] >= 0.0 && !is_added_point(scene.point_ids[point]);
}

/// The standard deviation of the points' places in images that their reprojection errors tell.
double noise_of_errors_px(const Scene& scene)
{
    constexpr double kUnknown = -1.0;
    return median_of_some(scene.num_points(), [&](std::size_t point) {
        const auto coordinates = 2.0 * static_cast<double>(scene.tracks[point].size());
        if (!is_matched(scene, point) || coordinates <= 3.0) return kUnknown;
        return scene.errors_px[point] * std::sqrt(coordinates / (coordinates - 3.0)) /
               std::sqrt(std::numbers::pi / 2.0);
    });
}

/// Whether a face turns too far if its corners go so far.
bool turns(const HalfEdgeMesh& mesh, const Vectors& ways, FaceHandle face)
{
    constexpr double kLeastCosine = 0.5;
    if (mesh.is_deleted(face)) return false;
    const std::array<VertexHandle, 3> corners = mesh.corners(face);
    std::array<Vector3d, 3> after;
    bool is_moved = false;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Vector3d& way = ways[index(corners[i])];
        after[i] = mesh.point(corners[i]) + way;
        is_moved = is_moved || !way.isZero(0.0);
    }
    if (!is_moved) return false;
    const auto [a, b, c] = mesh.triangle(face);
    const Vector3d old_normal = scaled_normal(a, b, c);
    const Vector3d new_normal = scaled_normal(after[0], after[1], after[2]);
    const double scale = old_normal.norm() * new_normal.norm();
    return !(old_normal.dot(new_normal) > kLeastCosine * scale);
}

using Faces = std::vector<FaceHandle>;

/// Those of `count` faces that turn too far, in their order.
template <typename FaceAt>
Faces turning(const HalfEdgeMesh& mesh, const Vectors& ways, std::size_t count,
              const FaceAt& face_at)
{
    return parallel_collect<FaceHandle>(count, [&](std::size_t i, Faces& faces) {
        if (turns(mesh, ways, face_at(i))) faces.push_back(face_at(i));
    });
}

/// Halves ways, or ends them, until no face turns too far. How many vertices that holds.
std::int64_t hold_back(const HalfEdgeMesh& mesh, Vectors& ways)
{
    constexpr std::uint8_t kHalvings = 2; // then the vertex stays
    std::vector<std::uint8_t> halvings(ways.size());
    Faces turned =
        turning(mesh, ways, mesh.n_faces(), [](std::size_t i) { return handle_at<FaceHandle>(i); });
    while (!turned.empty()) {
        std::vector<VertexHandle> held;
        for (const FaceHandle face : turned) {
            for (const VertexHandle corner : mesh.corners(face)) {
                if (!ways[index(corner)].isZero(0.0)) held.push_back(corner);
            }
        }
        sort_unique(held);
        Faces around;
        for (const VertexHandle vertex : held) {
            const bool goes_on = halvings[index(vertex)]++ < kHalvings;
            ways[index(vertex)] *= goes_on ? 0.5 : 0.0;
            for (const auto face : mesh.vf_range(vertex)) {
                around.push_back(face);
            }
        }
        sort_unique(around);
        turned = turning(mesh, ways, around.size(), [&](std::size_t i) { return around[i]; });
    }
    return static_cast<std::int64_t>(halvings.size()) - std::ranges::count(halvings, 0);
}

/// The ways of the vertices to the surface that those around agree on.
class Settler {
  public:
    Settler(const HalfEdgeMesh& mesh, const Scene& scene, const Progress& progress)
        : mesh_(mesh),
          scene_(scene),
          positions_(of_vertices(mesh, [&](VertexHandle v) { return mesh.point(v); })),
          neighborhoods_(ring_neighborhoods(mesh, positions_, progress)),
          normals_(of_vertices(mesh, [&](VertexHandle v) { return vertex_normal(mesh, v); })),
          spreads_(positions_.size(), Vector3d::Zero()),
          variances_(positions_.size())
    {
        normals_ = filtered_normals(positions_, normals_, neighborhoods_);
        const std::vector<double> focals_px = mean_focals_px(scene.cameras);
        parallel_for(positions_.size(), [&](std::size_t v) {
            const std::uint32_t point = point_of(v);
            if (point == kNoPoint) return;
            spreads_[v] = covariance_of_a_pixel(scene, point, focals_px) * normals_[v];
            variances_[v] = normals_[v].dot(spreads_[v]);
        });
    }

    double noise_px() const { return filter().noise_px(); }

    Vectors ways(double gate, const Progress& progress) const
    {
        constexpr double kMost = 0.25; // of the spacing
        Vectors ways(positions_.size(), Vector3d::Zero());
        const std::vector<double> spacings = vertex_spacings(mesh_);
        parallel_for(ways.size(), progress, [&](std::size_t v) {
            if (!may_move(v)) return;
            const Vector3d way = filter().estimate(v, gate) - positions_[v];
            const double most = kMost * spacings[v];
            ways[v] = way.norm() > most ? Vector3d(way * (most / way.norm())) : way;
        });
        return ways;
    }

  private:
    BilateralFilter filter() const
    {
        return {{positions_, normals_, spreads_, variances_}, neighborhoods_};
    }

    std::uint32_t point_of(std::size_t v) const
    {
        return mesh_.data(handle_at<VertexHandle>(v)).scene_point;
    }

    bool may_move(std::size_t v) const
    {
        const auto vertex = handle_at<VertexHandle>(v);
        return !mesh_.is_deleted(vertex) && !mesh_.is_boundary(vertex) && point_of(v) != kNoPoint &&
               is_matched(scene_, point_of(v));
    }

    const HalfEdgeMesh& mesh_;
    const Scene& scene_;
    Vectors positions_;
    Neighborhoods neighborhoods_;
    Vectors normals_;
    Vectors spreads_;
    std::vector<double> variances_;
};

} // namespace

SettleCounts settle_vertices(HalfEdgeMesh& mesh, const Scene& scene, const DenoiseOptions& options,
                             const Progress& progress)
{
    SettleCounts counts;
    counts.vertices = num_vertices_left(mesh);
    counts.noise_px = noise_of_errors_px(scene);
    if (!(options.denoise * counts.noise_px > 0.0)) return counts;
    const Settler settler(mesh, scene, progress.part(0.0, 0.5));
    counts.noise_px = std::min(counts.noise_px, settler.noise_px());
    const double gate = options.denoise * counts.noise_px;
    if (!(gate > 0.0)) return counts;
    Vectors ways = settler.ways(gate, progress.part(0.6, 0.9));
    counts.held = hold_back(mesh, ways);
    for (const VertexHandle vertex : mesh.vertices()) {
        const Vector3d& way = ways[index(vertex)];
        if (way.isZero(0.0)) continue;
        mesh.set_point(vertex, mesh.point(vertex) + way);
        ++counts.moved;
    }
    set_vertex_normals(mesh);
    return counts;
}

} // namespace vcarve
