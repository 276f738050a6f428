#include "steps/6_refine/flip_ridges.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>
#include <queue>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using OpenMesh::EdgeHandle;
using OpenMesh::HalfedgeHandle;

double angle_between(const Vector3d& a, const Vector3d& b)
{
    return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// An edge between two faces, and the edges beside it.
struct EdgeFlap {
    HalfedgeHandle edge;     ///< of one face
    HalfedgeHandle opposite; ///< of the other
    /// From the end of `edge` on: two edges of the one face, then two of the other.
    std::array<HalfedgeHandle, 4> beside;
};

EdgeFlap flap_of(const HalfEdgeMesh& mesh, EdgeHandle edge)
{
    const HalfedgeHandle one = mesh.halfedge_handle(edge, 0);
    const HalfedgeHandle other = mesh.halfedge_handle(edge, 1);
    return {one,
            other,
            {mesh.next_halfedge_handle(one), mesh.prev_halfedge_handle(one),
             mesh.next_halfedge_handle(other), mesh.prev_halfedge_handle(other)}};
}

bool has_face(const HalfEdgeMesh& mesh, HalfedgeHandle edge)
{
    return !mesh.is_boundary(edge) && !mesh.is_deleted(mesh.face_handle(edge));
}

/// The normal of a triangle, twice its area long; zero if it is so thin that rounding decides on
/// it, as between points added along a crease.
Vector3d normal_of(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
    constexpr double kThin = 1e-5; // its height, of its longest edge
    const Vector3d normal = scaled_normal(a, b, c);
    const double longest_sq =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return normal.norm() > kThin * longest_sq ? normal : Vector3d::Zero();
}

/// The normal of the face across an edge; of none at a rim.
std::optional<Vector3d> normal_across(const HalfEdgeMesh& mesh, HalfedgeHandle edge)
{
    const HalfedgeHandle across = mesh.opposite_halfedge_handle(edge);
    if (!has_face(mesh, across)) return std::nullopt;
    const auto [a, b, c] = mesh.triangle(mesh.face_handle(across));
    return normal_of(a, b, c);
}

/// By how many radians the surface bends less if an edge is flipped; 0 if it must not be.
double gain_of_flip(const HalfEdgeMesh& mesh, EdgeHandle edge)
{
    constexpr double kMostTurn = 80.0 * std::numbers::pi / 180.0; // boxes have right angles
    const EdgeFlap flap = flap_of(mesh, edge);
    if (!has_face(mesh, flap.edge) || !has_face(mesh, flap.opposite)) return 0.0;
    const Vector3d& a = mesh.point(mesh.from_vertex_handle(flap.edge));
    const Vector3d& b = mesh.point(mesh.to_vertex_handle(flap.edge));
    const Vector3d& c = mesh.point(mesh.to_vertex_handle(flap.beside[0]));
    const Vector3d& d = mesh.point(mesh.to_vertex_handle(flap.beside[2]));
    const Vector3d abc = normal_of(a, b, c);
    const Vector3d bad = normal_of(b, a, d);
    const Vector3d dca = normal_of(d, c, a);
    const Vector3d cdb = normal_of(c, d, b);
    const bool is_ridge = abc.dot(d - a) < 0.0;
    if (!is_ridge || bad.isZero(0.0) || dca.isZero(0.0) || cdb.isZero(0.0)) return 0.0;
    const double turn = angle_between(abc, bad);
    const double turn_after = angle_between(dca, cdb); // over a right angle if they fold over
    if (turn > kMostTurn || turn_after > kMostTurn) return 0.0;
    double gain = turn - turn_after;
    const std::array<const Vector3d*, 4> before = {&abc, &abc, &bad, &bad};
    const std::array<const Vector3d*, 4> after = {&cdb, &dca, &dca, &cdb};
    for (std::size_t i = 0; i < flap.beside.size(); ++i) {
        const std::optional<Vector3d> across = normal_across(mesh, flap.beside[i]);
        if (!across) continue;
        if (across->isZero(0.0)) return 0.0;
        gain += angle_between(*before[i], *across) - angle_between(*after[i], *across);
    }
    return gain;
}

struct Flip {
    double gain = 0.0;
    EdgeHandle edge;

    bool operator<(const Flip& other) const ///< for a queue: less gain comes later
    {
        return gain != other.gain ? gain < other.gain : other.edge < edge;
    }
};

/// Below this many radians a flip is left be: rounding would decide on it.
constexpr double kLeastGain = 0.01;

} // namespace

std::int64_t flip_ridges(HalfEdgeMesh& mesh, const Progress& progress)
{
    std::vector<Flip> flips = parallel_collect<Flip>(
        mesh.n_edges(), progress, [&](std::size_t i, std::vector<Flip>& found) {
            const auto edge = handle_at<EdgeHandle>(i);
            const double gain = gain_of_flip(mesh, edge);
            if (gain > kLeastGain) found.push_back({gain, edge});
        });
    std::priority_queue<Flip> queue({}, std::move(flips));
    const auto queue_again = [&](HalfedgeHandle halfedge) {
        const EdgeHandle edge = mesh.edge_handle(halfedge);
        const double gain = gain_of_flip(mesh, edge);
        if (gain > kLeastGain) queue.push({gain, edge});
    };
    std::int64_t count = 0;
    while (!queue.empty()) {
        const Flip flip = queue.top();
        queue.pop();
        // What has changed since it was queued was queued again.
        if (gain_of_flip(mesh, flip.edge) != flip.gain || !mesh.is_flip_ok(flip.edge)) continue;
        mesh.flip(flip.edge);
        ++count;
        for (const HalfedgeHandle beside : flap_of(mesh, flip.edge).beside) {
            queue_again(beside);
            const HalfedgeHandle across = mesh.opposite_halfedge_handle(beside);
            if (!has_face(mesh, across)) continue;
            queue_again(mesh.next_halfedge_handle(across));
            queue_again(mesh.prev_halfedge_handle(across));
        }
    }
    set_vertex_normals(mesh);
    return count;
}

} // namespace vcarve
