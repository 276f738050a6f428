#include "steps/5_labels/boundary.h"

#include "base/numbers.h"
#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/local_shape.h"
#include "model/camera.h"
#include "model/scene_points.h"
#include "steps/4_visibility/face_visibility.h"
#include "steps/5_labels/plain_walls.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <utility>

namespace vcarve {

namespace {

using Eigen::Vector3d;

/// The sort key of facets.
std::pair<Index, int> key(const CellFacet& facet)
{
    return {facet.cell, facet.slot};
}

/// Whether a view outside the hull sees a hull facet: it saw a corner, or its image shows a corner,
/// an edge midpoint or the centroid. Nothing can occlude the facet from there.
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

/// Whether a hull facet is seen from within the hull, and not from outside.
bool is_seen_from_within(const TetMesh& cells, const Scene& scene, Index infinite)
{
    const Face face = face_of(cells, {infinite, kHullSlot});
    const Vector3d inwards = face_normal(cells.positions, face);
    return is_seen(scene, face, inwards) && !is_seen_from_beyond(cells, scene, face, inwards);
}

} // namespace

std::vector<CellFacet> boundary_facets(const TetMesh& cells, const Labels& labels)
{
    return parallel_collect<CellFacet>(cells.cells.size(), [&](std::size_t cell, auto& facets) {
        if (labels[cell] == Label::outside) {
            return;
        }
        for (int slot = cells.cells[cell].first_bounded_slot(); slot < 4; ++slot) {
            if (labels[cells.cells[cell].neighbors[slot]] == Label::outside) {
                facets.push_back({static_cast<Index>(cell), slot});
            }
        }
    });
}

Face face_of(const TetMesh& cells, const CellFacet& facet)
{
    const auto& corners = cells.cells[facet.cell].vertices;
    const auto& [a, b, c] = kFacetCorners[facet.slot]; // counter-clockwise from inside
    return {corners[a], corners[c], corners[b]};
}

std::size_t place_of(const CellFacet& facet, const std::vector<CellFacet>& facets)
{
    const auto found = std::ranges::lower_bound(facets, key(facet), {}, key);
    return static_cast<std::size_t>(found - facets.begin());
}

std::vector<Face> boundary_faces(const TetMesh& cells, const std::vector<CellFacet>& facets)
{
    require_indexable(facets.size(), kMostFaces, "faces");
    std::vector<Face> faces(facets.size());
    parallel_for(faces.size(), [&](std::size_t i) { faces[i] = face_of(cells, facets[i]); });
    return faces;
}

void close_hull(const TetMesh& cells, Labels& labels)
{
    parallel_for(labels.size(), [&](std::size_t i) {
        if (cells.cells[i].is_infinite()) labels[i] = Label::outside;
    });
}

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

std::int64_t continue_along_hull(const TetMesh& cells, const Scene& scene,
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
    // Local edge lengths and normals are those of the boundary, and of hull facets at vertices that
    // are not on the boundary.
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
        if (edges.relative_size(face) <= options.hull_edge && continues_surface(face, normals))
            solid.push_back(seen[i]);
    };
    const auto solid = parallel_collect<Index>(seen.size(), judge, 64);
    for (const Index cell : solid) {
        labels[cell] = Label::inside;
    }
    std::vector<Index> open;
    std::ranges::copy_if(seen, std::back_inserter(open),
                         [&](Index cell) { return labels[cell] == Label::outside; });
    const std::vector<Index> walls = plain_walls(cells, scene, open, labels);
    for (const Index cell : walls) {
        labels[cell] = Label::inside;
    }
    return static_cast<std::int64_t>(solid.size() + walls.size());
}

} // namespace vcarve
