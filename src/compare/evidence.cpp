#include "compare/evidence.h"

#include "base/median.h"
#include "base/parallel.h"
#include "base/random_number.h"
#include "compare/sample.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"
#include "model/camera.h"
#include "steps/4_visibility/face_evidence.h"
#include "steps/4_visibility/face_visibility.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace vcarve {
namespace {

constexpr double kTouchSpacings = 1e-3; ///< nearer hits are the sample's own face
constexpr int kSamplesPerAreaSample = 8;
constexpr std::uint64_t kSightStream = 5;
constexpr std::uint64_t kAreaStream = 6;

std::uint64_t stream_seed(const Reference& reference, std::uint64_t stream)
{
    return (static_cast<std::uint64_t>(reference.options.seed) << 8U) + stream;
}

double share_of_ones(const std::vector<char>& flags)
{
    if (flags.empty()) return 0.0;
    return static_cast<double>(std::ranges::count(flags, 1)) / static_cast<double>(flags.size());
}

/// Whether the mesh stands between a view and a point it saw, or the point's place does not decide
/// it.
bool hides(const TriangleTree& tree, const Reference& reference, std::uint64_t sight)
{
    const std::vector<std::uint64_t>& begins = reference.scene.tracks.begins;
    const auto row = std::upper_bound(begins.begin(), begins.end(), sight) - 1;
    const auto point = static_cast<std::size_t>(row - begins.begin());
    const Eigen::Vector3d& position = reference.scene.positions[point];
    const Eigen::Vector3d& center =
        reference.scene.views[reference.scene.tracks.views[sight]].center;
    const Eigen::Vector3d line = center - position;
    const double length = line.norm();
    const double skip = reference.options.spacings * reference.spacings[point];
    return length > skip && tree.is_met(position + line * (skip / length), center);
}

double hidden_share(const TriangleTree& tree, const Reference& reference)
{
    const std::uint64_t sights = reference.scene.num_sights();
    const std::uint64_t most = static_cast<std::uint64_t>(reference.options.samples);
    std::vector<char> hidden(std::min(sights, most));
    const double step = static_cast<double>(sights) / static_cast<double>(hidden.size());
    const std::uint64_t seed = stream_seed(reference, kSightStream);
    parallel_for(
        hidden.size(),
        [&](std::size_t i) {
            const double within = sights > most ? random_number(seed, i) : 0.5;
            const double place = (static_cast<double>(i) + within) * step;
            const auto sight = std::min(static_cast<std::uint64_t>(place), sights - 1);
            hidden[i] = hides(tree, reference, sight) ? 1 : 0;
        },
        64);
    return share_of_ones(hidden);
}

/// Per point: its distance to the mesh in its own spacings.
std::vector<double> distances_in_spacings(const TriangleTree& tree, const Reference& reference)
{
    std::vector<double> result(reference.scene.num_points());
    parallel_for(
        result.size(),
        [&](std::size_t i) {
            const double spacing = reference.spacings[i];
            const double distance = tree.distance(reference.scene.positions[i]);
            result[i] = distance > 0.0 ? distance / spacing : 0.0;
        },
        64);
    return result;
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
        sample_surface(mesh.mesh, count, stream_seed(reference, kAreaStream));
    std::vector<char> unsupported(samples.positions.size());
    parallel_for(
        unsupported.size(),
        [&](std::size_t i) {
            const Eigen::Vector3d normal =
                face_normal(mesh.mesh.positions, mesh.mesh.faces[samples.faces[i]]);
            unsupported[i] = supported(mesh, reference, samples.positions[i], normal) ? 0 : 1;
        },
        16);
    return share_of_ones(unsupported);
}

/// The middles of the edges of one face.
std::vector<Eigen::Vector3d> rim_of(const TriMesh& mesh)
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

std::int64_t count_seen_rim(const MeasuredMesh& mesh, const Reference& reference)
{
    const std::vector<Eigen::Vector3d> middles = rim_of(mesh.mesh);
    std::vector<char> seen(middles.size());
    parallel_for(
        seen.size(),
        [&](std::size_t i) {
            seen[i] = std::ranges::any_of(reference.scene.views, [&](const View& view) {
                return view_sees(view, middles[i], mesh, reference);
            });
        },
        16);
    return std::ranges::count(seen, 1);
}

} // namespace

bool view_sees(const View& view, const Eigen::Vector3d& position, const MeasuredMesh& mesh,
               const Reference& reference)
{
    const double touch = kTouchSpacings * reference.median_spacing;
    const Eigen::Vector3d line = view.center - position;
    const double length = line.norm();
    if (length <= touch) return false;
    if (!view_shows(view, reference.scene.cameras[view.camera], position)) return false;
    return !mesh.tree.is_met(position + line * (touch / length), view.center);
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
    figures.seen_boundary_edges = count_seen_rim(mesh, reference);
    figures.rays = measure_view_rays(mesh, reference);
    return figures;
}

} // namespace vcarve
