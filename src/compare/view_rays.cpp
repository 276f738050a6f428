#include "compare/view_rays.h"

#include "base/parallel.h"
#include "model/camera.h"
#include "model/pixel_grid.h"
#include "vcarve/error.h"
#include "vcarve/reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace vcarve {

namespace {

constexpr std::size_t kSamplesPerRay = 4;
constexpr std::size_t kLeastRaysAView = 36;

/// Per ray: what it first meets of a surface.
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

std::vector<ViewRay> view_rays(const Scene& scene, const CompareOptions& options)
{
    const std::size_t wanted = static_cast<std::size_t>(options.samples) / kSamplesPerRay;
    const std::size_t most =
        std::max(wanted / std::max<std::size_t>(scene.views.size(), 1), kLeastRaysAView);
    const auto rays_of_view = [&](std::size_t index, std::vector<ViewRay>& rays) {
        const View& view = scene.views[index];
        const Camera& camera = scene.cameras[view.camera];
        // As long as the centre is far from zero, so that adding it rounds little off.
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
    stage.end({{"faces of the closed surface", faces}});
}

} // namespace vcarve
