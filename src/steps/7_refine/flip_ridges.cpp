#include "steps/7_refine/flip_ridges.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

namespace vcarve {

namespace {

using Eigen::Vector3d;
using OpenMesh::EdgeHandle;
using OpenMesh::HalfedgeHandle;

/// Between unit vectors.
double angle_between(const Vector3d& a, const Vector3d& b)
{
    return std::acos(std::clamp(a.dot(b), -1.0, 1.0));
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

/// The unit normal of a triangle; zero if it is so thin that rounding decides on it, as between
/// points added along a crease.
Vector3d normal_of(const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
    constexpr double kThin = 1e-5; // its height, of its longest edge
    const Vector3d normal = scaled_normal(a, b, c);
    const double length = normal.norm();
    const double longest_sq =
        std::max({(b - a).squaredNorm(), (c - b).squaredNorm(), (a - c).squaredNorm()});
    return length > kThin * longest_sq ? Vector3d(normal / length) : Vector3d::Zero();
}

/// A surface and the normals of its faces, as its edges are flipped.
class RidgeFlipper {
  public:
    explicit RidgeFlipper(HalfEdgeMesh& mesh) : mesh_(mesh), normals_(mesh.n_faces())
    {
        parallel_for(normals_.size(), [&](std::size_t f) {
            const auto face = handle_at<OpenMesh::FaceHandle>(f);
            if (mesh.is_deleted(face)) return;
            const auto [a, b, c] = mesh.triangle(face);
            normals_[f] = normal_of(a, b, c);
        });
    }

    /// By how many radians the surface bends less if an edge is flipped; 0 if it must not be.
    double gain(EdgeHandle edge) const
    {
        const double least_cosine = std::cos(kMostTurn);
        const EdgeFlap flap = flap_of(mesh_, edge);
        if (!has_face(mesh_, flap.edge) || !has_face(mesh_, flap.opposite)) return 0.0;
        const Vector3d& abc = normal(flap.edge);
        const Vector3d& bad = normal(flap.opposite);
        if (abc.dot(bad) < least_cosine) return 0.0;
        const Vector3d& a = mesh_.point(mesh_.from_vertex_handle(flap.edge));
        const Vector3d& d = mesh_.point(mesh_.to_vertex_handle(flap.beside[2]));
        const bool is_ridge = abc.dot(d - a) < 0.0;
        if (!is_ridge || bad.isZero(0.0)) return 0.0;
        const Vector3d& b = mesh_.point(mesh_.to_vertex_handle(flap.edge));
        const Vector3d& c = mesh_.point(mesh_.to_vertex_handle(flap.beside[0]));
        const Vector3d dca = normal_of(d, c, a);
        const Vector3d cdb = normal_of(c, d, b);
        const double cosine_after = dca.dot(cdb); // negative where they fold over
        if (cosine_after < least_cosine || dca.isZero(0.0) || cdb.isZero(0.0)) return 0.0;
        double gain = angle_between(abc, bad) - angle_between(dca, cdb);
        const std::array<const Vector3d*, 4> before = {&abc, &abc, &bad, &bad};
        const std::array<const Vector3d*, 4> after = {&cdb, &dca, &dca, &cdb};
        for (std::size_t i = 0; i < flap.beside.size(); ++i) {
            const HalfedgeHandle across = mesh_.opposite_halfedge_handle(flap.beside[i]);
            if (!has_face(mesh_, across)) continue;
            const Vector3d& beside = normal(across);
            if (beside.isZero(0.0)) return 0.0;
            gain += angle_between(*before[i], beside) - angle_between(*after[i], beside);
        }
        return gain;
    }

    /// Flips an edge where OpenMesh can; whether it was flipped.
    bool flip(EdgeHandle edge)
    {
        if (!mesh_.is_flip_ok(edge)) return false;
        mesh_.flip(edge);
        for (const int side : {0, 1}) {
            const auto face = mesh_.face_handle(mesh_.halfedge_handle(edge, side));
            const auto [a, b, c] = mesh_.triangle(face);
            normals_[index(face)] = normal_of(a, b, c);
        }
        return true;
    }

    /// Shows visit(edge) the edges whose gain a flip of this edge has changed, but for itself.
    template <typename Visit>
    void visit_changed(EdgeHandle edge, const Visit& visit) const
    {
        for (const HalfedgeHandle beside : flap_of(mesh_, edge).beside) {
            visit(mesh_.edge_handle(beside));
            const HalfedgeHandle across = mesh_.opposite_halfedge_handle(beside);
            if (!has_face(mesh_, across)) continue;
            visit(mesh_.edge_handle(mesh_.next_halfedge_handle(across)));
            visit(mesh_.edge_handle(mesh_.prev_halfedge_handle(across)));
        }
    }

  private:
    static constexpr double kMostTurn = 80.0 * std::numbers::pi / 180.0; // boxes have right angles

    const Vector3d& normal(HalfedgeHandle edge) const
    {
        return normals_[index(mesh_.face_handle(edge))];
    }

    HalfEdgeMesh& mesh_;
    std::vector<Vector3d> normals_;
};

struct Flip {
    double gain = 0.0;
    EdgeHandle edge;

    bool operator<(const Flip& other) const ///< for a queue: less gain comes later
    {
        return gain != other.gain ? gain < other.gain : other.edge < edge;
    }
};

/// Below this many radians a flip is left be.
constexpr double kLeastGain = 0.2;

} // namespace

std::int64_t flip_ridges(HalfEdgeMesh& mesh, const Progress& progress)
{
    RidgeFlipper flipper(mesh);
    const auto collect = [&](std::size_t i, std::vector<Flip>& found) {
        const auto edge = handle_at<EdgeHandle>(i);
        const double gain = flipper.gain(edge);
        if (gain > kLeastGain) found.push_back({gain, edge});
    };
    std::vector<Flip> flips = parallel_collect<Flip>(mesh.n_edges(), progress, collect);
    std::vector<double> gains(mesh.n_edges()); // of the edges that are queued
    for (const Flip& flip : flips) {
        gains[index(flip.edge)] = flip.gain;
    }
    std::priority_queue<Flip> queue({}, std::move(flips));
    std::int64_t count = 0;
    while (!queue.empty()) {
        const Flip flip = queue.top();
        queue.pop();
        if (gains[index(flip.edge)] != flip.gain) continue; // queued anew since
        gains[index(flip.edge)] = 0.0;
        if (!flipper.flip(flip.edge)) continue;
        ++count;
        flipper.visit_changed(flip.edge, [&](EdgeHandle edge) {
            const double gain = flipper.gain(edge);
            gains[index(edge)] = gain;
            if (gain > kLeastGain) queue.push({gain, edge});
        });
    }
    set_vertex_normals(mesh);
    return count;
}

} // namespace vcarve
