#include "compare/evidence.h"

#include "base/median.h"
#include "base/parallel_count.h"
#include "base/random_number.h"
#include "compare/reference.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"
#include "model/camera.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/4_visibility/seen_corners.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace vcarve {
namespace {

constexpr double kTouchSpacings = 1e-3; ///< nearer hits are the sample's own face
constexpr int kSamplesPerAreaSample = 8;

/// Whether the mesh stands between a view and a point it saw, or the point's place does not decide
/// it.
bool hides(const TriangleTree& tree, const Reference& reference, std::uint64_t sight)
{
    const std::vector<std::uint64_t>& begins = reference.scene.tracks.begins;
    const auto row = std::upper_bound(begins.begin(), begins.end(), sight) - 1;
    const auto point = static_cast<std::size_t>(row - begins.begin());
    const View& view = reference.scene.views[reference.scene.tracks.views[sight]];
    return is_hidden(reference.scene.positions[point], view.center, tree,
                     reference.options.spacings * reference.spacings[point]);
}

double hidden_share(const TriangleTree& tree, const Reference& reference)
{
    const std::uint64_t sights = reference.scene.num_sights();
    const std::uint64_t most = static_cast<std::uint64_t>(reference.options.samples);
    const std::size_t count = std::min(sights, most);
    const double step = static_cast<double>(sights) / static_cast<double>(count);
    const std::uint64_t seed = stream_seed(reference.options, RandomStream::sight);
    const auto hides_one = [&](std::size_t i) {
        const double within = sights > most ? random_number(seed, i) : 0.5;
        const double place = (static_cast<double>(i) + within) * step;
        return hides(tree, reference, std::min(static_cast<std::uint64_t>(place), sights - 1));
    };
    return share_of(parallel_count(count, hides_one, 64), count);
}

/// Per point: its distance to the mesh in its own spacings.
std::vector<double> distances_in_spacings(const TriangleTree& tree, const Reference& reference)
{
    std::vector<double> distances = distances_to(tree, reference.scene.positions);
    for (std::size_t i = 0; i < distances.size(); ++i) {
        if (distances[i] > 0.0) distances[i] /= reference.spacings[i];
    }
    return distances;
}

/// Whether some view sees a sample of the mesh from its front.
bool supported(const MeasuredMesh& mesh, const Reference& reference,
               const Eigen::Vector3d& position, const Eigen::Vector3d& normal)
{
    return std::ranges::any_of(reference.scene.views, [&](const View& view) {
        return stands_before(view.center, position, normal) &&
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

/// The middles of the edges of one face.
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
    figures.hidden_sights = hidden_share(mesh.tree, reference);
    figures.missed_points = static_cast<double>(missed) / static_cast<double>(distances.size());
    figures.unsupported_area = unsupported_share(mesh, reference);
    figures.median_distance = median(std::move(distances));
    figures.seen_boundary_edges = count_seen_boundary(mesh, reference);
    figures.rays = measure_view_rays(mesh, reference);
    return figures;
}

} // namespace vcarve
