#include "steps/6_surface/openness.h"

#include "base/parallel.h"
#include "geometry/triangle_tree.h"
#include "model/camera.h"
#include "model/views.h"
#include "steps/4_visibility/view_walk.h"
#include "steps/5_labels/boundary.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kRays = 4096;
constexpr std::size_t kMaxViews = 512;

/// A view, and a point that it saw, or kInfinite.
struct Onlooker {
    std::uint32_t view;
    Index vertex = kInfinite;
};

/// At most kMaxViews views, evenly spread.
std::vector<Onlooker> onlookers(const Scene& scene)
{
    const std::size_t num_views = scene.views.size();
    std::vector<Onlooker> chosen(std::min(num_views, kMaxViews));
    std::vector<std::uint32_t> place_of_view(num_views, kInfinite);
    for (std::size_t i = 0; i < chosen.size(); ++i) {
        chosen[i].view = static_cast<std::uint32_t>(i * num_views / chosen.size());
        place_of_view[chosen[i].view] = static_cast<std::uint32_t>(i);
    }
    std::size_t missing = chosen.size();
    for (Index point = 0; point < scene.num_points() && missing > 0; ++point) {
        for (const std::uint32_t view : scene.tracks[point]) {
            const std::uint32_t place = place_of_view[view];
            if (place == kInfinite) continue;
            chosen[place].vertex = point;
            place_of_view[view] = kInfinite;
            --missing;
        }
    }
    return chosen;
}

/// A boundary with flags of the kept facets.
struct PartOfBoundary {
    const TetMesh& cells;
    const Labels& labels;
    const std::vector<CellFacet>& facets;
    const FaceFlags& keep;

    bool holds(const CellFacet& ahead) const
    {
        return labels[ahead.cell] != labels[cells.cells[ahead.cell].neighbors[ahead.slot]];
    }
    /// Whether a boundary facet is kept, given from either side.
    bool is_kept(const CellFacet& ahead) const
    {
        const bool from_inside = labels[ahead.cell] == Label::inside;
        return keep[place_of(from_inside ? ahead : cells.other_side(ahead), facets)] != 0;
    }
};

/// A length greater than the distance from `place` to any point.
double reach_from(const Vector3d& place, const Eigen::AlignedBox3d& box)
{
    return 2.0 * ((place - box.center()).norm() + box.diagonal().norm());
}

/// The openness for one view, along at most `most` rays.
Openness seen_by(const Onlooker& onlooker, const Scene& scene, const Eigen::AlignedBox3d& box,
                 const PartOfBoundary& part, std::size_t most)
{
    Openness openness;
    if (onlooker.vertex == kInfinite) return openness;
    const View& view = scene.views[onlooker.view];
    const Camera& camera = scene.cameras[view.camera];
    const ViewWalk walk(part.cells, view.center, onlooker.vertex);
    const double reach = reach_from(view.center, box);
    for (const Eigen::Vector2d& pixel : pixel_grid(camera, most)) {
        const std::optional<Vector3d> in_cam = ray(camera, pixel);
        if (!in_cam) continue;
        const Vector3d direction = view.cam_from_world.conjugate() * *in_cam;
        bool meets_boundary = false;
        bool meets_kept = false;
        const bool is_followed = walk.along(direction, reach, [&](const CellFacet& ahead) {
            if (!part.holds(ahead)) return true;
            meets_boundary = true;
            meets_kept = part.is_kept(ahead);
            return !meets_kept;
        });
        if (!is_followed) continue;
        ++openness.rays;
        if (!meets_boundary) {
            ++openness.past;
        } else if (!meets_kept) {
            openness.open.push_back({view.center, view.center + reach * direction});
        }
    }
    return openness;
}

} // namespace

Openness measure_openness(const TetMesh& cells, const Labels& labels,
                          const std::vector<CellFacet>& facets, const FaceFlags& keep,
                          const Scene& scene)
{
    const std::vector<Onlooker> chosen = onlookers(scene);
    Eigen::AlignedBox3d box;
    for (const Vector3d& position : cells.positions) {
        box.extend(position);
    }
    const PartOfBoundary part = {cells, labels, facets, keep};
    const std::size_t most = kRays / std::max<std::size_t>(chosen.size(), 1);
    std::vector<Openness> of_views(chosen.size());
    parallel_for(
        chosen.size(),
        [&](std::size_t i) { of_views[i] = seen_by(chosen[i], scene, box, part, most); }, 1);
    Openness all;
    for (const Openness& of_view : of_views) {
        all.rays += of_view.rays;
        all.past += of_view.past;
        all.open.insert(all.open.end(), of_view.open.begin(), of_view.open.end());
    }
    return all;
}

std::int64_t count_free(const std::vector<ViewLine>& lines,
                        const std::vector<std::array<Vector3d, 3>>& triangles)
{
    const TriangleTree tree(triangles);
    const auto is_free = [&](std::size_t i) { return !tree.is_met(lines[i].eye, lines[i].end); };
    return static_cast<std::int64_t>(parallel_count(lines.size(), is_free, 16));
}

} // namespace vcarve
