#include "steps/6_refine/simplify.h"

#include "mesh/half_edge_mesh.h"

#include <OpenMesh/Core/Geometry/QuadricT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::Vec3d;
using OpenMesh::Geometry::Quadricd;

Vector3d to_eigen(const Vec3d& v)
{
    return {v[0], v[1], v[2]};
}

/// 1 for an equilateral triangle, 0 for one without area.
double roundness(const std::array<Vec3d, 3>& t)
{
    const double sum_sq =
        (t[1] - t[0]).sqrnorm() + (t[2] - t[1]).sqrnorm() + (t[0] - t[2]).sqrnorm();
    const double twice_area = cross(t[1] - t[0], t[2] - t[0]).norm();
    return sum_sq > 0.0 ? 2.0 * std::sqrt(3.0) * twice_area / sum_sq : 0.0;
}

/// What a collapse costs, and whether the new faces may be. The one module of the decimater: it can
/// ask for the sights last, and only where the collapse is the cheapest of its vertex so far.
class GuardedQuadric : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
  public:
    using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
    using Handle = OpenMesh::Decimater::ModHandleT<GuardedQuadric>;

    explicit GuardedQuadric(HalfEdgeMesh& mesh)
        : Base(mesh, false), quadrics_(mesh.n_vertices()), verdicts_(8 * mesh.n_vertices() + 1)
    {
    }

    void set_guard(const SightGuard& guard) { guard_ = &guard; }

    void initialize() override
    {
        const HalfEdgeMesh& mesh = Base::mesh();
        double sum_sq = 0.0;
        for (const auto face : mesh.faces()) {
            add_face(face);
        }
        for (const auto edge : mesh.edges()) {
            sum_sq += mesh.calc_edge_sqr_length(edge);
            if (mesh.is_boundary(edge)) add_rim(edge);
        }
        const double mean_sq =
            sum_sq / static_cast<double>(std::max<std::size_t>(mesh.n_edges(), 1));
        unit_ = mean_sq > 0.0 ? mean_sq * mean_sq : 1.0;
    }

    float collapse_priority(const CollapseInfo& collapse) override
    {
        if (collapse.v0.idx() != vertex_) {
            vertex_ = collapse.v0.idx();
            best_ = HUGE_VALF;
        }
        Quadricd quadric = quadrics_[index(collapse.v0)];
        quadric += quadrics_[index(collapse.v1)];
        // Free of units, so that a float holds it.
        const auto cost = static_cast<float>(std::max(quadric(collapse.p1), 0.0) / unit_);
        if (!(cost < best_) || !is_allowed(collapse)) return Base::ILLEGAL_COLLAPSE;
        best_ = cost;
        return cost;
    }

    void postprocess_collapse(const CollapseInfo& collapse) override
    {
        quadrics_[index(collapse.v1)] += quadrics_[index(collapse.v0)];
        vertex_ = -1;
    }

  private:
    using Triangle = std::array<Vec3d, 3>;

    /// Whether a triangle of these vertices, ascending, blocks a free sight.
    struct Verdict {
        std::array<int, 3> corners{-1, -1, -1};
        bool blocks = false;
    };

    void add_face(OpenMesh::FaceHandle face)
    {
        const HalfEdgeMesh& mesh = Base::mesh();
        Vec3d normal;
        mesh.calc_sector_normal(mesh.halfedge_handle(face), normal);
        const double twice_area = normal.norm();
        if (!(twice_area > 0.0)) return;
        const auto first = mesh.to_vertex_handle(mesh.halfedge_handle(face));
        Quadricd quadric(normal / twice_area, mesh.point(first));
        quadric *= twice_area / 2.0;
        for (const auto vertex : mesh.fv_range(face)) {
            quadrics_[index(vertex)] += quadric;
        }
    }

    /// A plane along a rim and across its face.
    void add_rim(OpenMesh::EdgeHandle edge)
    {
        constexpr double kRimWeight = 4.0;
        const HalfEdgeMesh& mesh = Base::mesh();
        const auto inner = mesh.opposite_halfedge_handle(
            mesh.is_boundary(mesh.halfedge_handle(edge, 0)) ? mesh.halfedge_handle(edge, 0)
                                                            : mesh.halfedge_handle(edge, 1));
        Vec3d normal;
        mesh.calc_sector_normal(inner, normal);
        const Vec3d along = mesh.calc_edge_vector(inner);
        const Vec3d across = cross(normal, along);
        if (!(across.norm() > 0.0)) return;
        Quadricd quadric(across.normalized(), mesh.point(mesh.to_vertex_handle(inner)));
        quadric *= kRimWeight * along.sqrnorm();
        quadrics_[index(mesh.to_vertex_handle(inner))] += quadric;
        quadrics_[index(mesh.from_vertex_handle(inner))] += quadric;
    }

    /// Whether the faces that the collapse changes may be as they become.
    bool is_allowed(const CollapseInfo& collapse)
    {
        changed_.clear();
        double worst_before = 1.0;
        double worst_after = 1.0;
        for (const auto face : mesh().vf_range(collapse.v0)) {
            const std::array<int, 3> corners = corners_of(face);
            const Triangle before = triangle(corners);
            worst_before = std::min(worst_before, roundness(before));
            if (face == collapse.fl || face == collapse.fr) continue;
            std::array<int, 3> moved = corners;
            std::ranges::replace(moved, collapse.v0.idx(), collapse.v1.idx());
            const Triangle after = triangle(moved);
            if (turns_too_far(before, after)) return false;
            worst_after = std::min(worst_after, roundness(after));
            changed_.push_back(moved);
        }
        return worst_after >= std::min(kSliver, worst_before) &&
               std::ranges::none_of(changed_, [&](const auto& corners) { return blocks(corners); });
    }

    std::array<int, 3> corners_of(OpenMesh::FaceHandle face)
    {
        std::array<int, 3> corners{};
        std::size_t i = 0;
        for (const auto vertex : mesh().fv_range(face)) {
            corners[i++] = vertex.idx();
        }
        return corners;
    }

    Triangle triangle(const std::array<int, 3>& corners)
    {
        const auto at = [&](int corner) { return mesh().point(OpenMesh::VertexHandle(corner)); };
        return {at(corners[0]), at(corners[1]), at(corners[2])};
    }

    /// Vertices never move, so what was found out holds: neighbours ask for the same again.
    bool blocks(std::array<int, 3> corners)
    {
        std::ranges::sort(corners);
        const std::size_t hash = (static_cast<std::size_t>(corners[0]) * 0x9E3779B97F4A7C15U) ^
                                 (static_cast<std::size_t>(corners[1]) * 0xC2B2AE3D27D4EB4FU) ^
                                 (static_cast<std::size_t>(corners[2]) * 0x165667B19E3779F9U);
        Verdict& verdict = verdicts_[(hash >> 32U) % verdicts_.size()];
        if (verdict.corners != corners) {
            const Triangle t = triangle(corners);
            verdict = {corners, guard_->blocks({to_eigen(t[0]), to_eigen(t[1]), to_eigen(t[2])})};
        }
        return verdict.blocks;
    }

    static bool turns_too_far(const Triangle& before, const Triangle& after)
    {
        constexpr double kLeastCosine = 0.5;
        const Vec3d old_normal = cross(before[1] - before[0], before[2] - before[0]);
        const Vec3d new_normal = cross(after[1] - after[0], after[2] - after[0]);
        const double scale = old_normal.norm() * new_normal.norm();
        return !(dot(old_normal, new_normal) > kLeastCosine * scale);
    }

    static constexpr double kSliver = 0.1; ///< of roundness

    const SightGuard* guard_ = nullptr;
    std::vector<Quadricd> quadrics_; ///< one a vertex
    double unit_ = 1.0;
    int vertex_ = -1;   ///< whose collapses are being compared
    float best_ = 0.0F; ///< cheapest of them so far
    std::vector<std::array<int, 3>> changed_;
    std::vector<Verdict> verdicts_; ///< by hash, the last one at each place
};

} // namespace

TriMesh simplify_surface(const TriMesh& mesh, const SightGuard& guard,
                         const SimplifyOptions& options)
{
    HalfEdgeMesh half_edges = half_edge_mesh(mesh);
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(half_edges);
    GuardedQuadric::Handle module;
    decimater.add(module);
    decimater.module(module).set_guard(guard);
    decimater.initialize();
    decimater.decimate_to_faces(0, static_cast<std::size_t>(options.faces));

    std::vector<char> keep_faces(half_edges.n_faces(), 0);
    for (std::size_t f = 0; f < keep_faces.size(); ++f) {
        const OpenMesh::FaceHandle face(static_cast<int>(f));
        keep_faces[f] = half_edges.status(face).deleted() ? 0 : 1;
    }
    return kept_surface(half_edges, keep_faces, mesh);
}

} // namespace vcarve
