#include "steps/7_refine/simplify.h"

#include "base/parallel.h"
#include "mesh/half_edge_mesh.h"

#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <algorithm>
#include <cmath>

namespace vcarve {
namespace {

using Eigen::Vector3d;
using OpenMesh::EdgeHandle;
using OpenMesh::HalfedgeHandle;
using OpenMesh::VertexHandle;
using OpenMesh::Geometry::Quadricd;

using Collapse = OpenMesh::Decimater::CollapseInfoT<HalfEdgeMesh>;
using Corners = std::array<VertexHandle, 3>;
using Triangle = std::array<Vector3d, 3>;

Triangle triangle(const HalfEdgeMesh& mesh, const Corners& corners)
{
    return {mesh.point(corners[0]), mesh.point(corners[1]), mesh.point(corners[2])};
}

/// Calls visit(corners) for each face that a collapse changes, as it becomes, until that says no.
/// Returns whether it never did.
template <typename Visit>
bool all_changed_faces(const HalfEdgeMesh& mesh, const Collapse& collapse, const Visit& visit)
{
    for (const auto face : mesh.vf_range(collapse.v0)) {
        if (face == collapse.fl || face == collapse.fr) continue;
        Corners corners = mesh.corners(face);
        std::ranges::replace(corners, collapse.v0, collapse.v1);
        if (!visit(corners)) return false;
    }
    return true;
}

/// What a collapse costs: OpenMesh's quadrics, and for rims, which these know nothing of, the same
/// for planes along a rim and across its face.
class RimQuadrics : public OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh> {
  public:
    using Faces = OpenMesh::Decimater::ModQuadricT<HalfEdgeMesh>;
    using Handle = OpenMesh::Decimater::ModHandleT<RimQuadrics>;

    explicit RimQuadrics(HalfEdgeMesh& mesh) : Faces(mesh), rims_(mesh.n_vertices()) {}

    void initialize() override
    {
        Faces::initialize();
        for (const auto edge : mesh().edges()) {
            if (mesh().is_boundary(edge)) add_rim(edge);
        }
    }

    float collapse_priority(const Collapse& collapse) override
    {
        Quadricd rim = rims_[index(collapse.v0)];
        rim += rims_[index(collapse.v1)];
        // Rounding must not make a cost of nothing a negative one, which would rule it out.
        return std::max(Faces::collapse_priority(collapse), 0.0F) +
               static_cast<float>(std::max(rim(collapse.p1), 0.0));
    }

    void postprocess_collapse(const Collapse& collapse) override
    {
        Faces::postprocess_collapse(collapse);
        rims_[index(collapse.v1)] += rims_[index(collapse.v0)];
    }

  private:
    void add_rim(EdgeHandle edge)
    {
        constexpr double kRimWeight = 4.0;
        const HalfedgeHandle first = mesh().halfedge_handle(edge, 0);
        const HalfedgeHandle inner =
            mesh().is_boundary(first) ? mesh().opposite_halfedge_handle(first) : first;
        const VertexHandle end = mesh().to_vertex_handle(inner);
        Vector3d normal;
        mesh().calc_sector_normal(inner, normal);
        const Vector3d along = mesh().calc_edge_vector(inner);
        const Vector3d across = normal.cross(along).normalized();
        const double offset = -across.dot(mesh().point(end));
        if (across.isZero()) return;
        Quadricd quadric(across.x(), across.y(), across.z(), offset);
        quadric *= kRimWeight * along.squaredNorm();
        rims_[index(end)] += quadric;
        rims_[index(mesh().from_vertex_handle(inner))] += quadric;
    }

    std::vector<Quadricd> rims_; ///< one a vertex
};

/// Rules out faces that are worse slivers than those they replace. OpenMesh's ModRoundnessT looks
/// at the wrong ones of the faces around and rounds to floats, and its ModAspectRatioT takes no
/// Eigen vectors.
class NoNewSlivers : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
  public:
    using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
    using Handle = OpenMesh::Decimater::ModHandleT<NoNewSlivers>;

    explicit NoNewSlivers(HalfEdgeMesh& mesh) : Base(mesh, true) {}

    float collapse_priority(const Collapse& collapse) override
    {
        constexpr double kSliver = 0.1; // of roundness
        double least = kSliver;
        for (const auto face : mesh().vf_range(collapse.v0)) {
            least = std::min(least, roundness(mesh().triangle(face)));
        }
        const bool is_legal = all_changed_faces(mesh(), collapse, [&](const Corners& corners) {
            return roundness(triangle(mesh(), corners)) >= least;
        });
        return is_legal ? Base::LEGAL_COLLAPSE : Base::ILLEGAL_COLLAPSE;
    }

  private:
    /// 1 for an equilateral triangle, 0 for one without area.
    static double roundness(const Triangle& t)
    {
        const double sum_sq =
            (t[1] - t[0]).squaredNorm() + (t[2] - t[1]).squaredNorm() + (t[0] - t[2]).squaredNorm();
        const double twice_area = (t[1] - t[0]).cross(t[2] - t[0]).norm();
        return sum_sq > 0.0 ? 2.0 * std::sqrt(3.0) * twice_area / sum_sq : 0.0;
    }
};

/// Rules out faces that would block a free sight. Asking costs more than all else, so collapses
/// that cost no less than one of the same vertex found legal before are ruled out unasked: the
/// decimater takes the cheapest of a vertex. Hence this module comes last.
class NoBlockedSights : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
  public:
    using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
    using Handle = OpenMesh::Decimater::ModHandleT<NoBlockedSights>;

    explicit NoBlockedSights(HalfEdgeMesh& mesh)
        : Base(mesh, true), verdicts_(8 * mesh.n_vertices() + 1)
    {
    }

    /// A unit of the mesh is so many units of the guard's scene.
    void set_guard(const SightGuard& guard, double unit)
    {
        guard_ = &guard;
        unit_ = unit;
    }
    void set_costs(RimQuadrics& costs) { costs_ = &costs; }

    float collapse_priority(const Collapse& collapse) override
    {
        if (collapse.v0 != vertex_) {
            vertex_ = collapse.v0;
            least_cost_ = HUGE_VALF;
        }
        const float cost = costs_->collapse_priority(collapse);
        const bool is_legal =
            cost < least_cost_ && all_changed_faces(mesh(), collapse, [&](const Corners& corners) {
                return !blocks(corners);
            });
        if (!is_legal) return Base::ILLEGAL_COLLAPSE;
        least_cost_ = cost;
        return Base::LEGAL_COLLAPSE;
    }

    void postprocess_collapse(const Collapse& /*collapse*/) override { vertex_.invalidate(); }

  private:
    /// Whether a triangle of these vertices, ascending, blocks a free sight.
    struct Verdict {
        std::array<int, 3> corners{-1, -1, -1};
        bool blocks = false;
    };

    /// Vertices never move, so what was found out holds: neighbours ask for the same again.
    bool blocks(const Corners& corners)
    {
        std::array<int, 3> numbers{corners[0].idx(), corners[1].idx(), corners[2].idx()};
        std::ranges::sort(numbers);
        const std::size_t hash = (static_cast<std::size_t>(numbers[0]) * 0x9E3779B97F4A7C15U) ^
                                 (static_cast<std::size_t>(numbers[1]) * 0xC2B2AE3D27D4EB4FU) ^
                                 (static_cast<std::size_t>(numbers[2]) * 0x165667B19E3779F9U);
        Verdict& verdict = verdicts_[(hash >> 32U) % verdicts_.size()];
        if (verdict.corners != numbers) {
            const auto [a, b, c] = triangle(mesh(), corners);
            verdict = {numbers, guard_->blocks({a * unit_, b * unit_, c * unit_})};
        }
        return verdict.blocks;
    }

    const SightGuard* guard_ = nullptr;
    double unit_ = 1.0;
    RimQuadrics* costs_ = nullptr;
    VertexHandle vertex_;           ///< whose collapses are being compared
    float least_cost_ = HUGE_VALF;  ///< of them so far
    std::vector<Verdict> verdicts_; ///< by hash, the last one at each place
};

/// Tells how far collapsing has come. A collapse takes two faces, one at a rim.
class CollapseProgress final : public OpenMesh::Decimater::Observer {
  public:
    CollapseProgress(const Progress& progress, std::size_t faces, std::size_t wanted)
        : Observer(Progress::kToldEvery),
          progress_(progress),
          collapses_(faces > wanted ? static_cast<double>(faces - wanted) / 2.0 : 0.0)
    {
    }

    void notify(std::size_t collapses) override
    {
        progress_.tell(std::min(1.0, static_cast<double>(collapses) / collapses_));
    }

  private:
    Progress progress_;
    double collapses_;
};

/// The power of two next to the mean length of an edge; 1 where that is none.
double usual_length(const HalfEdgeMesh& mesh)
{
    double sum = 0.0;
    for (const auto edge : mesh.edges()) {
        sum += mesh.calc_edge_length(edge);
    }
    const double mean = sum / static_cast<double>(std::max<std::size_t>(mesh.n_edges(), 1));
    return mean > 0.0 ? std::exp2(std::round(std::log2(mean))) : 1.0;
}

void scale(HalfEdgeMesh& mesh, double factor)
{
    parallel_for(mesh.n_vertices(),
                 [&](std::size_t v) { mesh.point(handle_at<VertexHandle>(v)) *= factor; });
}

void decimate(HalfEdgeMesh& mesh, const SightGuard& guard, double unit, std::size_t num_faces,
              const Progress& progress)
{
    constexpr double kMostTurnDeg = 60.0;
    mesh.request_face_normals();
    mesh.update_face_normals();
    OpenMesh::Decimater::DecimaterT<HalfEdgeMesh> decimater(mesh);
    RimQuadrics::Handle quadrics;
    OpenMesh::Decimater::ModNormalFlippingT<HalfEdgeMesh>::Handle flipping;
    NoNewSlivers::Handle slivers;
    NoBlockedSights::Handle sights;
    decimater.add(quadrics);
    decimater.add(flipping);
    decimater.add(slivers);
    decimater.add(sights);
    decimater.module(flipping).set_max_normal_deviation(kMostTurnDeg);
    decimater.module(sights).set_guard(guard, unit);
    decimater.module(sights).set_costs(decimater.module(quadrics));
    decimater.initialize();
    const auto num_left = static_cast<std::size_t>(num_faces_left(mesh));
    CollapseProgress told(progress, num_left, num_faces);
    decimater.set_observer(&told);
    // The decimater counts deleted faces as well.
    const std::size_t num_deleted = mesh.n_faces() - num_left;
    decimater.decimate_to_faces(0, num_faces + num_deleted);
    mesh.release_face_normals();
}

} // namespace

SimplifyCounts simplify_surface(HalfEdgeMesh& mesh, const SightGuard& guard,
                                const SimplifyOptions& options, const Progress& progress)
{
    SimplifyCounts counts{.faces_before = num_faces_left(mesh)};
    // OpenMesh's costs are floats: edges of about 1 keep them in range. Powers of two scale
    // exactly.
    const double unit = usual_length(mesh);
    scale(mesh, 1.0 / unit);
    decimate(mesh, guard, unit, static_cast<std::size_t>(options.faces), progress);
    scale(mesh, unit);
    set_vertex_normals(mesh);
    counts.faces = num_faces_left(mesh);
    return counts;
}

} // namespace vcarve
