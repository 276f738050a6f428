#include "steps/5_labels/hull_faces.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "steps/4_visibility/seen_corners.h"
#include "steps/5_labels/boundary.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// Whether a view beyond a facet of the hull shows a corner of it, the middle of an edge or its
/// own: nothing lies between them, so the view sees it.
bool is_seen_from_beyond(const TetMesh& cells, const Scene& scene, const Face& face,
                         const Vector3d& inwards)
{
    const Vector3d& a = cells.positions[face[0]];
    const Vector3d& b = cells.positions[face[1]];
    const Vector3d& c = cells.positions[face[2]];
    const std::array<Vector3d, 7> places = {
        a, b, c, (a + b) / 2, (b + c) / 2, (c + a) / 2, (a + b + c) / 3};
    if (std::ranges::any_of(
            face, [&](std::uint32_t point) { return is_seen_from_front(scene, point, -inwards); }))
        return true;
    return std::ranges::any_of(scene.views, [&](const View& view) {
        return inwards.dot(view.center - a) < 0.0 &&
               std::ranges::any_of(places, [&](const Vector3d& place) {
                   return view_shows(view, scene.cameras[view.camera], place);
               });
    });
}

/// Whether a facet of the hull is a surface seen from within the hull.
bool is_seen_from_within(const TetMesh& cells, const Scene& scene, Index infinite)
{
    const Face face = face_of(cells, {infinite, kHullSlot});
    const Vector3d inwards = face_normal(cells.positions, face);
    return is_seen(scene, face, inwards) && !is_seen_from_beyond(cells, scene, face, inwards);
}

} // namespace

std::vector<Index> uncrossed_hull_cells(const TetMesh& cells, const FlowNetwork& network)
{
    const auto look = [&](std::size_t i, std::vector<Index>& uncrossed) {
        if (!cells.cells[i].is_infinite()) return;
        const CellFacet beyond{static_cast<Index>(i), kHullSlot};
        const CellFacet within = cells.other_side(beyond);
        const auto& arcs = network.arc_capacities;
        if (arcs[within.cell][within.slot] == 0 && arcs[beyond.cell][beyond.slot] == 0)
            uncrossed.push_back(beyond.cell);
    };
    return parallel_collect<Index>(cells.cells.size(), look);
}

std::int64_t go_on_along_hull(const TetMesh& cells, const Scene& scene,
                              const std::vector<Index>& uncrossed, const HullOptions& options,
                              Labels& labels)
{
    if (options.hull_edge == 0.0) return 0;
    const auto look = [&](std::size_t i, std::vector<Index>& seen) {
        const Index within = cells.cells[uncrossed[i]].neighbors[kHullSlot];
        if (labels[within] == Label::outside && is_seen_from_within(cells, scene, uncrossed[i]))
            seen.push_back(uncrossed[i]);
    };
    const auto seen = parallel_collect<Index>(uncrossed.size(), look, 256);
    if (seen.empty()) return 0;
    // The boundary tells how long edges are and how the surface runs; where there is none, the
    // facets of the hull do.
    std::vector<Face> faces = boundary_faces(cells, boundary_facets(cells, labels));
    const std::size_t num_boundary = faces.size();
    std::vector<std::uint8_t> is_on_boundary(cells.positions.size());
    for (const Face& face : faces) {
        for (const std::uint32_t corner : face) {
            is_on_boundary[corner] = 1;
        }
    }
    FaceFlags tells(num_boundary, 1);
    for (const Index cell : seen) {
        const Face& face = faces.emplace_back(face_of(cells, {cell, kHullSlot}));
        const auto is_on = [&](std::uint32_t corner) { return is_on_boundary[corner] != 0; };
        tells.push_back(std::ranges::none_of(face, is_on) ? 1 : 0);
    }
    const LocalEdges edges(cells.positions, faces, tells);
    const SurfaceNormals normals(cells.positions, faces, edges);
    const auto judge = [&](std::size_t i, std::vector<Index>& solid) {
        const std::size_t face = num_boundary + i;
        if (edges.relative_size(face) <= options.hull_edge && goes_on(face, normals))
            solid.push_back(seen[i]);
    };
    const auto solid = parallel_collect<Index>(seen.size(), judge, 64);
    for (const Index cell : solid) {
        labels[cell] = Label::inside;
    }
    return static_cast<std::int64_t>(solid.size());
}

} // namespace vcarve
