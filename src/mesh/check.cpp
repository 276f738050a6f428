#include "mesh/check.h"

#include "base/parallel.h"
#include "base/statistics.h"
#include "base/union_find.h"
#include "geometry/cgal_kernel.h"
#include "geometry/triangle.h"
#include "mesh/edge_table.h"

#include <CGAL/box_intersection_d.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace vcarve {

namespace {

/// Counts boundary edges, non-manifold edges and inconsistent orientations.
void count_edges(std::span<const Face> faces, const EdgeTable& edges, MeshCheck& check)
{
    for (std::size_t e = 0; e < edges.size(); ++e) {
        const std::span<const HalfEdge> half_edges = edges[e];
        if (half_edges.size() == 1) ++check.boundary_edges;
        if (half_edges.size() > 2) ++check.nonmanifold_edges;
        if (half_edges.size() == 2 && tail(faces, half_edges[0]) == tail(faces, half_edges[1])) {
            ++check.orientation_faults;
        }
    }
}

std::int64_t num_components(std::span<const Face> faces, const EdgeTable& edges)
{
    UnionFind connected(faces.size());
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const HalfEdge half_edge : edges[e]) {
            connected.join(edges[e][0] / 3, half_edge / 3);
        }
    }
    std::int64_t count = 0;
    for (std::uint32_t f = 0; f < faces.size(); ++f) {
        if (!is_degenerate(faces[f]) && connected.root(f) == f) ++count;
    }
    return count;
}

/// The corner of a half-edge's face at `vertex`, which is an end of the half-edge.
HalfEdge corner_at(std::span<const Face> faces, HalfEdge half_edge, std::uint32_t vertex)
{
    return tail(faces, half_edge) == vertex ? half_edge : next_half_edge(half_edge);
}

/// A vertex is manifold if edges of at most two faces connect all its corners. The corners then
/// form one fan or one disk.
void count_vertices(const TriMesh& mesh, const EdgeTable& edges, MeshCheck& check)
{
    const std::span<const Face> faces(mesh.faces);
    UnionFind around(3 * faces.size());
    std::vector<char> crowded(mesh.positions.size(), 0);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        for (const std::uint32_t v : {tail(faces, edges[e][0]), head(faces, edges[e][0])}) {
            const HalfEdge first = corner_at(faces, edges[e][0], v);
            for (const HalfEdge half_edge : edges[e]) {
                around.join(first, corner_at(faces, half_edge, v));
            }
            if (edges[e].size() > 2) crowded[v] = 1;
        }
    }

    std::vector<std::uint32_t> fans(mesh.positions.size(), 0);
    for (HalfEdge corner = 0; corner < 3 * faces.size(); ++corner) {
        const bool counts = !is_degenerate(faces[corner / 3]) && around.root(corner) == corner;
        if (counts) ++fans[tail(faces, corner)];
    }
    for (std::size_t v = 0; v < fans.size(); ++v) {
        if (fans[v] == 0) ++check.unreferenced_vertices;
        if (fans[v] > 1 || crowded[v] != 0) ++check.nonmanifold_vertices;
    }
}

double total_area(const TriMesh& mesh)
{
    double area = 0.0;
    for (const Face& face : mesh.faces) {
        if (!is_degenerate(face)) area += face_area(mesh.positions, face);
    }
    return area;
}

std::array<double, 3> edge_lengths(const TriMesh& mesh, const Face& face)
{
    const auto length = [&](int from, int to) {
        return (mesh.positions[face[to]] - mesh.positions[face[from]]).norm();
    };
    return {length(0, 1), length(1, 2), length(2, 0)};
}

double usual_edge(const TriMesh& mesh)
{
    constexpr std::size_t kFaces = 4096;
    const std::size_t count = std::min(mesh.faces.size(), kFaces);
    std::vector<double> lengths;
    lengths.reserve(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
        const Face& face = mesh.faces[i * mesh.faces.size() / count];
        std::ranges::copy(edge_lengths(mesh, face), std::back_inserter(lengths));
    }
    return median(std::move(lengths));
}

struct Areas {
    double all = 0.0;
    double of_long = 0.0;
};

using Corners = std::array<Kernel::Point_3, 3>;
using Box =
    CGAL::Box_intersection_d::Box_with_info_d<double, 3, std::uint32_t,
                                              CGAL::Box_intersection_d::ID_FROM_BOX_ADDRESS>;

Kernel::Triangle_3 triangle(const Corners& corners)
{
    return {corners[0], corners[1], corners[2]};
}

/// Moves the corners that are not in `others` to the front. Returns their number.
std::ptrdiff_t own_first(Corners& corners, const Corners& others)
{
    const auto is_own = [&](const Kernel::Point_3& corner) {
        return std::ranges::find(others, corner) == others.end();
    };
    return std::partition(corners.begin(), corners.end(), is_own) - corners.begin();
}

bool intersect(Corners a, Corners b)
{
    const std::ptrdiff_t own = own_first(a, b);
    own_first(b, a);
    switch (own) {
    case 0:
        return true;
    case 1: // whether the faces overlap beside their common edge
        return CGAL::coplanar(a[0], a[1], a[2], b[0]) &&
               CGAL::coplanar_orientation(a[1], a[2], a[0], b[0]) == CGAL::POSITIVE;
    case 2:
        return CGAL::do_intersect(triangle(a), Kernel::Segment_3(b[0], b[1])) ||
               CGAL::do_intersect(triangle(b), Kernel::Segment_3(a[0], a[1]));
    default:
        return CGAL::do_intersect(triangle(a), triangle(b));
    }
}

} // namespace

MeshCheck check_mesh(const TriMesh& mesh)
{
    MeshCheck check;
    check.vertices = static_cast<std::int64_t>(mesh.positions.size());
    check.faces = static_cast<std::int64_t>(mesh.faces.size());
    check.degenerate_faces = std::ranges::count_if(mesh.faces, is_degenerate);

    const EdgeTable edges = gather_edges(mesh.faces, mesh.positions.size());
    count_edges(mesh.faces, edges, check);
    check.components = num_components(mesh.faces, edges);
    count_vertices(mesh, edges, check);
    check.euler_characteristic = (check.vertices - check.unreferenced_vertices) -
                                 static_cast<std::int64_t>(edges.size()) +
                                 (check.faces - check.degenerate_faces);
    check.area = total_area(mesh);
    return check;
}

double long_area(const TriMesh& mesh, double times)
{
    if (mesh.faces.empty()) return 0.0;
    const double most = times * usual_edge(mesh);
    const auto areas_of = [&](std::size_t i) {
        const Face& face = mesh.faces[i];
        const double area = face_area(mesh.positions, face);
        const bool is_long = longest_edge(mesh.positions, face) > most;
        return Areas{.all = area, .of_long = is_long ? area : 0.0};
    };
    const auto plus = [](const Areas& a, const Areas& b) {
        return Areas{.all = a.all + b.all, .of_long = a.of_long + b.of_long};
    };
    const Areas sum = parallel_sum(mesh.faces.size(), Areas(), areas_of, plus);
    return sum.all > 0.0 ? sum.of_long / sum.all : 0.0;
}

std::int64_t count_self_intersections(const TriMesh& mesh)
{
    const auto corners_of = [&](std::uint32_t face) {
        Corners corners;
        std::ranges::transform(mesh.faces[face], corners.begin(),
                               [&](std::uint32_t v) { return to_cgal(mesh.positions[v]); });
        return corners;
    };
    std::vector<Box> boxes;
    boxes.reserve(mesh.faces.size());
    for (std::uint32_t f = 0; f < mesh.faces.size(); ++f) {
        const Corners corners = corners_of(f);
        if (CGAL::collinear(corners[0], corners[1], corners[2])) continue;
        boxes.emplace_back(CGAL::bbox_3(corners.begin(), corners.end()), f);
    }
    std::vector<const Box*> all; // pointers sort faster than boxes
    for (const Box& box : boxes) {
        all.push_back(&box);
    }
    constexpr std::ptrdiff_t kFewBoxes = 1000; // twice as fast as CGAL's default of 10
    std::vector<std::pair<std::uint32_t, std::uint32_t>> near;
    const auto keep = [&](const Box* a, const Box* b) { near.emplace_back(a->info(), b->info()); };
    CGAL::box_self_intersection_d(all.begin(), all.end(), keep, kFewBoxes);
    return static_cast<std::int64_t>(parallel_count(near.size(), [&](std::size_t i) {
        return intersect(corners_of(near[i].first), corners_of(near[i].second));
    }));
}

} // namespace vcarve
