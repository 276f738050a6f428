#include "steps/5_labels/hull_faces.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/local_edges.h"
#include "mesh/surface_normals.h"
#include "mesh/used_vertices.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "steps/4_visibility/face_evidence.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>

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

/// Facets of the hull and the faces of a boundary around them, over vertices of their own. How long
/// edges are and how the surface runs the boundary tells, and where there is none the facets do.
struct Surroundings {
    Surroundings(const Boundary& boundary, const TetMesh& cells, const std::vector<Index>& infinite)
    {
        for (const Index cell : infinite) {
            faces.push_back(face_of(cells, {cell, kHullSlot}));
        }
        std::vector<std::uint32_t> around;
        for (const Face& face : faces) {
            for (const std::uint32_t corner : face) {
                std::ranges::copy(boundary.edges().faces_at()[corner], std::back_inserter(around));
            }
        }
        std::ranges::sort(around);
        around.erase(std::unique(around.begin(), around.end()), around.end());
        const auto is_on_boundary = [&](std::uint32_t corner) {
            return !boundary.edges().faces_at()[corner].empty();
        };
        for (const Face& face : faces) {
            tells.push_back(std::ranges::none_of(face, is_on_boundary) ? 1 : 0);
        }
        for (const std::uint32_t face : around) {
            faces.push_back(boundary.faces()[face]);
            tells.push_back(1);
        }
        const auto vertices = used_vertices(faces, cells.positions.size());
        renumber(faces, vertices, cells.positions.size());
        positions = values_at(vertices, cells.positions);
    }

    std::vector<Face> faces; ///< the facets come first
    FaceFlags tells;         ///< whether a face tells of the surface
    std::vector<Vector3d> positions;
};

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

std::int64_t go_on_along_hull(const Scene& scene, const std::vector<Index>& uncrossed,
                              Labelling& labelling)
{
    constexpr double kMostEdges = 20.0;
    constexpr double kGoesOn = 0.8; // cosine, about 37 degrees
    constexpr double kNotKnown = -1.0;
    const TetMesh& cells = labelling.cells();
    const auto look = [&](std::size_t i, std::vector<Index>& seen) {
        const Index within = cells.cells[uncrossed[i]].neighbors[kHullSlot];
        if (labelling.labels()[within] == Label::outside &&
            is_seen_from_within(cells, scene, uncrossed[i]))
            seen.push_back(uncrossed[i]);
    };
    const auto seen = parallel_collect<Index>(uncrossed.size(), look, 256);
    if (seen.empty()) return 0;
    const Surroundings around(labelling.boundary(), cells, seen);
    const LocalEdges edges(around.positions, around.faces, around.tells);
    const SurfaceNormals normals(around.positions, around.faces, edges);
    const auto judge = [&](std::size_t i, std::vector<Index>& solid) {
        if (edges.relative_size(i) <= kMostEdges && normals.cosines(i, kNotKnown)[2] >= kGoesOn)
            solid.push_back(seen[i]);
    };
    const auto solid = parallel_collect<Index>(seen.size(), judge, 64);
    labelling.set(solid, Label::inside);
    return static_cast<std::int64_t>(solid.size());
}

} // namespace vcarve
