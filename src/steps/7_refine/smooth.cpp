#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "steps/7_refine/refine.h"

#include <Eigen/Geometry>
#include <OpenMesh/Tools/Smoother/SmootherT.hh>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::FaceHandle;
using OpenMesh::VertexHandle;

using Positions = std::vector<Vector3d>; ///< one per vertex
using Triangle = std::array<Vector3d, 3>;

Vector3d twice_area(const Triangle& t)
{
    return scaled_normal(t[0], t[1], t[2]);
}

struct FaceFrame {
    Vector3d center;
    Vector3d normal; ///< unit, or zero
    double area = 0.0;
};

std::vector<FaceFrame> face_frames(const HalfEdgeMesh& mesh, const Positions& positions)
{
    std::vector<FaceFrame> frames(mesh.n_faces());
    parallel_for(frames.size(), [&](std::size_t f) {
        const auto [a, b, c] = mesh.corners(handle_at<FaceHandle>(f));
        const Triangle corners{positions[index(a)], positions[index(b)], positions[index(c)]};
        const Vector3d normal = twice_area(corners);
        const double length = normal.norm();
        frames[f].center = (corners[0] + corners[1] + corners[2]) / 3.0;
        frames[f].area = length / 2.0;
        frames[f].normal = length > 0.0 ? Vector3d(normal / length) : Vector3d::Zero();
    });
    return frames;
}

/// The mean of the normals around a face, weighted by area, distance and similarity.
Vector3d filtered_normal(const HalfEdgeMesh& mesh, const std::vector<FaceFrame>& frames,
                         std::size_t f)
{
    constexpr double kSpread = 0.2; // of unit normals, about 11 degrees
    const FaceFrame& self = frames[f];
    double reach = 0.0;
    double num_beside = 0.0;
    for (const auto beside : mesh.ff_range(handle_at<FaceHandle>(f))) {
        reach += (frames[index(beside)].center - self.center).norm();
        num_beside += 1.0;
    }
    if (!(reach > 0.0)) return self.normal;
    reach /= num_beside;
    Vector3d sum = Vector3d::Zero();
    for (const auto vertex : mesh.fv_range(handle_at<FaceHandle>(f))) {
        for (const auto around : mesh.vf_range(vertex)) {
            const FaceFrame& other = frames[index(around)];
            const double far = (other.center - self.center).squaredNorm() / (reach * reach);
            const double unlike = (other.normal - self.normal).squaredNorm() / (kSpread * kSpread);
            sum += other.area * std::exp(-(far + unlike) / 2.0) * other.normal;
        }
    }
    return sum.squaredNorm() > 0.0 ? sum.normalized() : self.normal;
}

/// The position at which the faces around a vertex agree better with their normals.
Vector3d fitted_position(const HalfEdgeMesh& mesh, const std::vector<FaceFrame>& frames,
                         const Vector3d& position, VertexHandle vertex)
{
    Vector3d sum = Vector3d::Zero();
    double count = 0.0;
    for (const auto face : mesh.vf_range(vertex)) {
        const FaceFrame& frame = frames[index(face)];
        sum += frame.normal * frame.normal.dot(frame.center - position);
        count += 1.0;
    }
    return count > 0.0 ? Vector3d(position + sum / count) : position;
}

/// The unconstrained positions of all vertices after one iteration.
Positions targets(const HalfEdgeMesh& mesh, Positions positions)
{
    constexpr int kRounds = 3;
    std::vector<FaceFrame> frames = face_frames(mesh, positions);
    for (int round = 0; round < kRounds; ++round) {
        std::vector<FaceFrame> filtered = frames;
        parallel_for(frames.size(),
                     [&](std::size_t f) { filtered[f].normal = filtered_normal(mesh, frames, f); });
        frames = std::move(filtered);
    }
    for (int round = 0; round < kRounds; ++round) {
        Positions fitted = positions;
        parallel_for(fitted.size(), [&](std::size_t v) {
            const auto vertex = handle_at<VertexHandle>(v);
            if (mesh.is_boundary(vertex)) return;
            fitted[v] = fitted_position(mesh, frames, positions[v], vertex);
        });
        positions = std::move(fitted);
        const std::vector<FaceFrame> moved = face_frames(mesh, positions);
        for (std::size_t f = 0; f < frames.size(); ++f) {
            frames[f].center = moved[f].center;
        }
    }
    return positions;
}

/// A vertex coloring. No two vertices of a set are adjacent, so they can move concurrently.
std::vector<std::vector<VertexHandle>> independent_sets(const HalfEdgeMesh& mesh)
{
    std::vector<std::size_t> set_of(mesh.n_vertices());
    std::vector<std::vector<VertexHandle>> sets;
    for (std::size_t v = 0; v < set_of.size(); ++v) {
        const auto vertex = handle_at<VertexHandle>(v);
        if (mesh.is_deleted(vertex)) continue;
        std::vector<char> taken(sets.size() + 1, 0);
        for (const auto neighbor : mesh.vv_range(vertex)) {
            if (index(neighbor) < v) taken[set_of[index(neighbor)]] = 1;
        }
        set_of[v] = static_cast<std::size_t>(std::ranges::find(taken, 0) - taken.begin());
        if (set_of[v] == sets.size()) sets.emplace_back();
        sets[set_of[v]].push_back(vertex);
    }
    return sets;
}

/// OpenMesh's smoother with other target positions, because its JacobiLaplaceSmootherT rounds off
/// edges. Free rays stay free, and boundary vertices stay in place.
class RayGuardedSmoother : public OpenMesh::Smoother::SmootherT<HalfEdgeMesh> {
  public:
    RayGuardedSmoother(HalfEdgeMesh& mesh, const RayGuard& guard, int iterations,
                       const Progress& progress)
        : SmootherT(mesh),
          guard_(guard),
          sets_(independent_sets(mesh)),
          spacings_(vertex_spacings(mesh)),
          positions_(mesh.n_vertices()),
          held_(mesh.n_vertices(), 0),
          to_move_(static_cast<double>(num_vertices_left(mesh)) * iterations),
          progress_(progress)
    {
        initialize(Tangential_and_Normal, C0);
    }

    SmoothCounts counts() const
    {
        SmoothCounts counts;
        counts.held = std::ranges::count(held_, 1);
        counts.vertices = num_vertices_left(mesh_);
        for (const auto vertex : mesh_.vertices()) {
            if (mesh_.point(vertex) != orig_position(vertex)) ++counts.moved;
        }
        return counts;
    }

  private:
    void compute_new_positions_C0() override
    {
        parallel_for(positions_.size(), [&](std::size_t v) {
            positions_[v] = mesh_.point(handle_at<VertexHandle>(v));
        });
        const Positions goals = targets(mesh_, positions_);
        for (const std::vector<VertexHandle>& set : sets_) {
            const auto size = static_cast<double>(set.size());
            parallel_for(
                set.size(), progress_.part(tried_ / to_move_, (tried_ + size) / to_move_),
                [&](std::size_t i) { move(set[i], goals[index(set[i])]); }, 64);
            tried_ += size;
        }
        for (const auto vertex : mesh_.vertices()) {
            set_new_position(vertex, positions_[index(vertex)]);
        }
    }
    void compute_new_positions_C1() override { compute_new_positions_C0(); }

    void move(VertexHandle vertex, const Vector3d& target)
    {
        if (!is_active(vertex)) return;
        constexpr double kReach = 0.5; // of the spacing, from the original position
        const std::size_t v = index(vertex);
        const Vector3d& start = orig_position(vertex);
        const Vector3d way = target - start;
        const double most = kReach * spacings_[v];
        const Vector3d goal =
            way.norm() > most ? Vector3d(start + way * (most / way.norm())) : target;
        for (const double share : {1.0, 0.5, 0.25}) {
            const Vector3d place = positions_[v] + share * (goal - positions_[v]);
            if (place == positions_[v]) return;
            if (!may_be_at(vertex, place)) continue;
            positions_[v] = place;
            return;
        }
    }

    bool may_be_at(VertexHandle vertex, const Vector3d& place)
    {
        std::vector<Triangle> before;
        std::vector<Triangle> after;
        for (const auto face : mesh_.vf_range(vertex)) {
            Triangle& was = before.emplace_back();
            Triangle& is = after.emplace_back();
            std::size_t i = 0;
            for (const auto corner : mesh_.fv_range(face)) {
                was[i] = positions_[index(corner)];
                is[i] = corner == vertex ? place : was[i];
                ++i;
            }
            if (turns_too_far(was, is)) return false;
        }
        if (!guard_.blocks(before, after)) return true;
        held_[index(vertex)] = 1;
        return false;
    }

    const RayGuard& guard_;
    std::vector<std::vector<VertexHandle>> sets_;
    std::vector<double> spacings_;
    Positions positions_; ///< current positions
    std::vector<char> held_;
    double tried_ = 0.0; ///< vertices tried in all iterations, of to_move_
    double to_move_;
    Progress progress_;
};

} // namespace

SmoothCounts smooth_surface(HalfEdgeMesh& mesh, const RayGuard& guard, const SmoothOptions& options,
                            const Progress& progress)
{
    RayGuardedSmoother smoother(mesh, guard, options.iterations, progress);
    smoother.smooth(static_cast<unsigned>(options.iterations));
    set_vertex_normals(mesh);
    return smoother.counts();
}

} // namespace vcarve
