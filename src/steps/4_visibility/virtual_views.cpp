#include "steps/4_visibility/virtual_views.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "geometry/point_tree.h"
#include "steps/4_visibility/ray_weights.h"
#include "steps/4_visibility/trace.h"
#include "steps/4_visibility/walk.h"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The evidence of the real rays per cell, as bits.
using Evidence = std::vector<std::uint8_t>;
constexpr std::uint8_t kCrossed = 1; ///< a ray crosses one of its facets
constexpr std::uint8_t kBehind = 2;  ///< it is directly behind a point that a view saw

void set_bit(Evidence& evidence, Index cell, std::uint8_t bit)
{
    std::atomic_ref<std::uint8_t>(evidence[cell]).fetch_or(bit, std::memory_order_relaxed);
}

Evidence gather_evidence(const TetMesh& cells, const Scene& scene, const Progress& progress)
{
    Evidence evidence(cells.cells.size(), 0);
    for_each_vertex(cells, progress, [&](Index vertex) {
        RayWalk outward(cells, vertex);
        RayWalk inward(cells, vertex);
        const Vector3d& point = cells.positions[vertex];
        for (const std::uint32_t view : scene.tracks[vertex]) {
            const Vector3d& center = scene.views[view].center;
            outward.to(center, [&](Index cell, int slot) {
                set_bit(evidence, cell, kCrossed);
                set_bit(evidence, cells.cells[cell].neighbors[slot], kCrossed);
            });
            const Index behind = inward.first_cell(2.0 * point - center);
            if (behind != kInfinite) {
                set_bit(evidence, behind, kBehind);
            }
        }
    });
    return evidence;
}

// ---- candidates ---------------------------------------------------------------------------------

/// The centroid of a cell.
struct Viewpoint {
    Vector3d center;
    double clearance; ///< distance to the nearest vertex of the cell
};

Viewpoint middle_of(const TetMesh& mesh, const Cell& cell)
{
    Vector3d center = Vector3d::Zero();
    for (const Index vertex : cell.vertices) {
        center += 0.25 * mesh.positions[vertex];
    }
    Viewpoint place{.center = center, .clearance = kUnlimited};
    for (const Index vertex : cell.vertices) {
        place.clearance = std::min(place.clearance, (mesh.positions[vertex] - center).norm());
    }
    return place;
}

/// The candidates for viewpoints. They are not at the surface, where all angles would be grazing,
/// nor far off in empty space, where the real views are.
std::vector<Viewpoint> free_places(const TetMesh& mesh, const Labels& labels,
                                   const Evidence& evidence)
{
    constexpr double kLeastClearance = 0.5; // in units of short_edge_length()
    constexpr double kMostClearance = 8.0;
    const double short_edge = short_edge_length(mesh);
    std::vector<Viewpoint> places;
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        const bool is_free = labels[i] == Label::outside && (evidence[i] & kCrossed) != 0;
        if (!is_free || mesh.cells[i].is_infinite()) {
            continue;
        }
        const Viewpoint place = middle_of(mesh, mesh.cells[i]);
        if (place.clearance >= kLeastClearance * short_edge &&
            place.clearance <= kMostClearance * short_edge) {
            places.push_back(place);
        }
    }
    return places;
}

/// Selects candidates by farthest-point sampling, from the one with the largest clearance.
std::vector<Viewpoint> spread(const std::vector<Viewpoint>& places, std::size_t count,
                              const Progress& progress)
{
    std::vector<Viewpoint> chosen;
    if (places.empty()) {
        return chosen;
    }
    const auto roomiest =
        std::max_element(places.begin(), places.end(), [](const Viewpoint& a, const Viewpoint& b) {
            return a.clearance < b.clearance;
        });
    auto next = static_cast<std::size_t>(roomiest - places.begin());
    std::vector<double> distances_sq(places.size(), kUnlimited);
    while (chosen.size() < count && distances_sq[next] > 0.0) {
        const Vector3d center = places[next].center;
        progress.report(chosen.size(), count);
        chosen.push_back(places[next]);
        parallel_for(places.size(), [&](std::size_t i) {
            distances_sq[i] = std::min(distances_sq[i], (places[i].center - center).squaredNorm());
        });
        next = static_cast<std::size_t>(std::max_element(distances_sq.begin(), distances_sq.end()) -
                                        distances_sq.begin());
    }
    return chosen;
}

// ---- visible points -----------------------------------------------------------------------------

/// The outward normal of the surface between inside and outside at each vertex: the mean over its
/// facets, weighted by area. Zero if the vertex has none.
std::vector<Vector3d> outward_normals(const TetMesh& mesh, const Labels& labels)
{
    std::vector<Vector3d> normals(mesh.positions.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < mesh.cells.size(); ++i) {
        const Cell& cell = mesh.cells[i];
        for (int slot = cell.first_bounded_slot(); slot < 4 && labels[i] == Label::inside; ++slot) {
            if (labels[cell.neighbors[slot]] == Label::inside) {
                continue;
            }
            const auto& [a, b, c] = kFacetCorners[slot]; // counter-clockwise from inside
            const Vector3d& corner = mesh.positions[cell.vertices[a]];
            const Vector3d normal = (mesh.positions[cell.vertices[c]] - corner)
                                        .cross(mesh.positions[cell.vertices[b]] - corner);
            for (const int k : kFacetCorners[slot]) {
                normals[cell.vertices[k]] += normal;
            }
        }
    }
    for (Vector3d& normal : normals) {
        normal.stableNormalize();
    }
    return normals;
}

/// The state before any virtual viewpoint is placed.
struct Known {
    const TetMesh& mesh;
    const Labels& labels;
    Evidence evidence;
    std::vector<Vector3d> normals; ///< per point
    PointTree points;
};

/// Whether the labeled surface at a point faces the viewpoint, with a margin, because the surface
/// is not final.
bool looks_towards(const Known& known, Index vertex, const Vector3d& center)
{
    constexpr double kLeastCosine = -0.3; // about 17 degrees beyond a right angle
    const Vector3d& normal = known.normals[vertex];
    const Vector3d way = (center - known.mesh.positions[vertex]).normalized();
    return !normal.isZero() && way.dot(normal) > kLeastCosine;
}

/// Whether the ray to a viewpoint passes through a cell that is known to be solid.
bool is_hidden(const Known& known, Index vertex, const Vector3d& center)
{
    bool hidden = false;
    RayWalk(known.mesh, vertex).to(center, [&](Index cell, int) {
        hidden = hidden ||
                 (known.labels[cell] == Label::inside && (known.evidence[cell] & kBehind) != 0);
    });
    return hidden;
}

std::vector<Index> seen_points(const Known& known, const Scene& scene, const Viewpoint& place)
{
    constexpr std::size_t kPointsAround = 1000;
    std::vector<PointTree::Near> nearest;
    known.points.find_nearest(place.center, kPointsAround, nearest);
    std::vector<Index> points;
    for (const PointTree::Near& near : nearest) {
        const auto vertex = static_cast<Index>(near.point);
        const bool is_seen = !scene.tracks[vertex].empty() &&
                             looks_towards(known, vertex, place.center) &&
                             !is_hidden(known, vertex, place.center);
        if (is_seen) points.push_back(vertex);
    }
    return points;
}

/// Transposes the points of each view to the views of each point.
Tracks tracks_of(const std::vector<std::vector<Index>>& points_of_views, std::size_t num_points)
{
    Tracks tracks;
    tracks.begins.assign(num_points + 1, 0);
    for (const auto& points : points_of_views) {
        for (const Index point : points) {
            ++tracks.begins[point + 1];
        }
    }
    std::partial_sum(tracks.begins.begin(), tracks.begins.end(), tracks.begins.begin());
    tracks.views.resize(tracks.begins.back());
    std::vector<std::uint64_t> ends(tracks.begins.begin(), tracks.begins.end() - 1);
    for (std::uint32_t view = 0; view < points_of_views.size(); ++view) {
        for (const Index point : points_of_views[view]) {
            tracks.views[ends[point]++] = view;
        }
    }
    return tracks;
}

} // namespace

VirtualRays find_virtual_rays(const TetMesh& cells, const Scene& scene, const Labels& labels,
                              const VirtualViewOptions& options, const Progress& progress)
{
    const Known known = {.mesh = cells,
                         .labels = labels,
                         .evidence = gather_evidence(cells, scene, progress.part(0.0, 0.5)),
                         .normals = outward_normals(cells, labels),
                         .points = PointTree(cells.positions)};
    const std::vector<Viewpoint> places =
        spread(free_places(cells, labels, known.evidence), static_cast<std::size_t>(options.count),
               progress.part(0.5, 0.8));
    VirtualRays rays;
    rays.centers.reserve(places.size());
    for (const Viewpoint& place : places) {
        rays.centers.push_back(place.center);
    }
    std::vector<std::vector<Index>> seen(places.size());
    parallel_for(
        seen.size(), progress.part(0.8, 1.0),
        [&](std::size_t i) { seen[i] = seen_points(known, scene, places[i]); }, 1);
    rays.tracks = tracks_of(seen, cells.positions.size());
    return rays;
}

} // namespace vcarve
