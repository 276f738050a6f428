#include "compare/evidence.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "base/stage_counts.h"
#include "base/statistics.h"
#include "compare/reference.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"
#include "model/camera.h"
#include "model/views.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <Eigen/Geometry>
#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

constexpr double kTouchSpacings = 1e-3; ///< nearer hits are the face of the sample
constexpr int kSamplesPerAreaSample = 8;

/// Whether the mesh occludes the point of a ray, farther than the tolerance from the point.
bool hides(const TriangleTree& tree, const Reference& reference, std::uint64_t ray)
{
    const std::vector<std::uint64_t>& begins = reference.scene.tracks.begins;
    const auto row = std::upper_bound(begins.begin(), begins.end(), ray) - 1;
    const auto point = static_cast<std::size_t>(row - begins.begin());
    const View& view = reference.scene.views[reference.scene.tracks.views[ray]];
    return is_hidden(reference.scene.positions[point], view.center, tree,
                     reference.options.spacings * reference.spacings[point]);
}

double hidden_share(const TriangleTree& tree, const Reference& reference)
{
    const std::uint64_t rays = reference.scene.num_rays();
    const std::uint64_t most = static_cast<std::uint64_t>(reference.options.samples);
    const std::size_t count = std::min(rays, most);
    const double step = static_cast<double>(rays) / static_cast<double>(count);
    const std::uint64_t seed = stream_seed(reference.options, RandomStream::ray);
    const auto hides_one = [&](std::size_t i) {
        const double within = rays > most ? random_number(seed, i) : 0.5;
        const double place = (static_cast<double>(i) + within) * step;
        return hides(tree, reference, std::min(static_cast<std::uint64_t>(place), rays - 1));
    };
    return share_of(parallel_count(count, hides_one, 64), count);
}

/// The distance of each point to the mesh, in spacings of the point.
std::vector<double> distances_in_spacings(const TriangleTree& tree, const Reference& reference)
{
    std::vector<double> distances = distances_to(tree, reference.scene.positions);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] > 0.0) distances[i] /= reference.spacings[i];
    }
    return distances;
}

/// Whether a view sees a sample of the mesh from its front.
bool supported(const MeasuredMesh& mesh, const Reference& reference,
               const Eigen::Vector3d& position, const Eigen::Vector3d& normal)
{
    return std::ranges::any_of(reference.scene.views, [&](const View& view) {
        return is_in_front_of(view.center, position, normal) &&
               view_sees(view, position, mesh, reference);
    });
}

double unsupported_share(const MeasuredMesh& mesh, const Reference& reference)
{
    const auto count = static_cast<std::size_t>(reference.options.samples / kSamplesPerAreaSample);
    const SurfaceSamples samples =
        sample_surface(mesh.mesh, count, stream_seed(reference.options, RandomStream::area));
    const auto is_unsupported = [&](std::size_t i) {
        const Eigen::Vector3d normal =
            face_normal(mesh.mesh.positions, mesh.mesh.faces[samples.faces[i]]);
        return !supported(mesh, reference, samples.positions[i], normal);
    };
    const std::size_t all = samples.positions.size();
    return share_of(parallel_count(all, is_unsupported, 16), all);
}

/// The midpoints of the boundary edges.
std::vector<Eigen::Vector3d> boundary_of(const TriMesh& mesh)
{
    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    std::vector<Eigen::Vector3d> middles;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (edges[e].size() != 1) continue;
        const HalfEdge half_edge = edges[e][0];
        middles.push_back(0.5 * (mesh.positions[tail(mesh.faces, half_edge)] +
                                 mesh.positions[head(mesh.faces, half_edge)]));
    }
    return middles;
}

std::int64_t count_seen_boundary(const MeasuredMesh& mesh, const Reference& reference)
{
    const std::vector<Eigen::Vector3d> middles = boundary_of(mesh.mesh);
    const auto is_seen = [&](std::size_t i) {
        return std::ranges::any_of(reference.scene.views, [&](const View& view) {
            return view_sees(view, middles[i], mesh, reference);
        });
    };
    return static_cast<std::int64_t>(parallel_count(middles.size(), is_seen, 16));
}

constexpr std::size_t kSamplesPerRay = 4;
constexpr std::size_t kLeastRaysAView = 36;

/// The first hit of each ray with a surface.
std::vector<std::optional<FirstHit>> first_hits(const TriangleTree& tree,
                                                const Reference& reference)
{
    std::vector<std::optional<FirstHit>> hits(reference.rays.size());
    parallel_for(
        hits.size(),
        [&](std::size_t i) {
            const ViewRay& ray = reference.rays[i];
            hits[i] = tree.first_hit(reference.scene.views[ray.view].center, ray.towards);
        },
        64);
    return hits;
}

} // namespace

bool view_sees(const View& view, const Eigen::Vector3d& position, const MeasuredMesh& mesh,
               const Reference& reference)
{
    const double touch = kTouchSpacings * reference.median_spacing;
    return (view.center - position).norm() > touch &&
           view_shows(view, reference.scene.cameras[view.camera], position) &&
           !is_hidden(position, view.center, mesh.tree, touch);
}

EvidenceFigures measure_against_views(const MeasuredMesh& mesh, const Reference& reference)
{
    std::vector<double> distances = distances_in_spacings(mesh.tree, reference);
    const auto missed = std::ranges::count_if(
        distances, [&](double distance) { return distance > reference.options.spacings; });

    EvidenceFigures figures;
    figures.hidden_rays = hidden_share(mesh.tree, reference);
    figures.missed_points = static_cast<double>(missed) / static_cast<double>(distances.size());
    figures.unsupported_area = unsupported_share(mesh, reference);
    figures.median_distance = median(std::move(distances));
    figures.seen_boundary_edges = count_seen_boundary(mesh, reference);
    figures.rays = measure_view_rays(mesh, reference);
    return figures;
}

std::vector<ViewRay> view_rays(const Scene& scene, const CompareOptions& options)
{
    const std::size_t wanted = static_cast<std::size_t>(options.samples) / kSamplesPerRay;
    const std::size_t most =
        std::max(wanted / std::max<std::size_t>(scene.views.size(), 1), kLeastRaysAView);
    const auto rays_of_view = [&](std::size_t index, std::vector<ViewRay>& rays) {
        const View& view = scene.views[index];
        const Camera& camera = scene.cameras[view.camera];
        // As long as the center's distance from zero, so that adding the center rounds off little.
        const double reach = view.center.isZero(0.0) ? 1.0 : view.center.norm();
        for (const Eigen::Vector2d& pixel : pixel_grid(camera, most)) {
            const std::optional<Eigen::Vector3d> direction = ray(camera, pixel);
            if (!direction) continue;
            const Eigen::Vector3d line = view.cam_from_world.conjugate() * *direction;
            rays.push_back({static_cast<std::uint32_t>(index), view.center + reach * line});
        }
    };
    return parallel_collect<ViewRay>(scene.views.size(), rays_of_view, 4);
}

void use_closed_surface(Reference& reference, const TriMesh& closed)
{
    const TriangleTree tree(in_frame(closed, reference.origin));
    std::vector<char> met;
    for (const std::optional<FirstHit>& hit : first_hits(tree, reference)) {
        met.push_back(hit ? 1 : 0);
    }
    reference.closed_hits = std::move(met);
}

std::optional<RayFigures> measure_view_rays(const MeasuredMesh& mesh, const Reference& reference)
{
    const std::vector<std::optional<FirstHit>> hits = first_hits(mesh.tree, reference);
    if (hits.empty()) return std::nullopt;
    const auto all = static_cast<double>(hits.size());
    const auto backs =
        std::ranges::count_if(hits, [](const auto& hit) { return hit && !hit->front; });
    RayFigures figures;
    figures.back_faces_seen = static_cast<double>(backs) / all;
    if (!reference.closed_hits) return figures;
    std::int64_t missing = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        missing += !hits[i] && (*reference.closed_hits)[i] != 0 ? 1 : 0;
    }
    figures.nothing_seen = static_cast<double>(missing) / all;
    return figures;
}

void add_closed_surface(Reference& reference, Scene model, Log& log)
{
    if (reference.rays.empty()) return;
    Stage stage(log, "closed");
    std::int64_t faces = 0;
    try {
        Options options;
        options.surface.closed = true;
        Log silent;
        const TriMesh closed = reconstruct(std::move(model), options, silent).mesh;
        use_closed_surface(reference, closed);
        faces = static_cast<std::int64_t>(closed.faces.size());
    } catch (const InputError& error) {
        log.note(fmt::format("no closed surface to measure against: {}", error.what()));
    }
    stage.end({{counts::kCompare.closed, faces}});
}

} // namespace vcarve
