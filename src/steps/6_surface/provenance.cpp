#include "steps/6_surface/provenance.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"
#include "steps/4_visibility/face_visibility.h"
#include "vcarve/error.h"

#include <Eigen/Geometry>
#include <fmt/core.h>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::uint64_t kLargestId = std::uint64_t{1} << 53; // doubles hold integers up to it

bool is_of_model(std::uint32_t point, const Scene& scene)
{
    return point != kNoPoint && scene.kind_of(point) == PointKind::measured;
}

void require_exact_ids(const TriMesh& mesh, const Scene& scene)
{
    for (const std::uint32_t point : mesh.points) {
        if (is_of_model(point, scene) && scene.point_ids[point] > kLargestId) {
            throw InputError(fmt::format("--attributes cannot write point {}: PLY stores ids up to "
                                         "{} only; omit --attributes",
                                         scene.point_ids[point], kLargestId));
        }
    }
}

ViewAgreement agreement_of_face(const HalfEdgeMesh& mesh, const Scene& scene,
                                OpenMesh::FaceHandle face)
{
    ViewAgreement agreement;
    const auto [a, b, c] = mesh.triangle(face);
    const Vector3d normal = scaled_normal(a, b, c);
    for (const auto vertex : mesh.corners(face)) {
        const std::uint32_t point = mesh.data(vertex).scene_point;
        if (point == kNoPoint) {
            continue;
        }
        for (const std::uint32_t view : scene.tracks[point]) {
            ++agreement.rays;
            agreement.facing += normal.dot(scene.views[view].center - mesh.point(vertex)) > 0.0;
        }
    }
    return agreement;
}

ViewAgreement sum(const ViewAgreement& a, const ViewAgreement& b)
{
    return {.rays = a.rays + b.rays, .facing = a.facing + b.facing};
}

} // namespace

Provenance find_provenance(const TriMesh& mesh, const Scene& scene)
{
    require_exact_ids(mesh, scene);
    Provenance found;
    found.point_ids.assign(mesh.positions.size(), -1);
    found.num_views.assign(mesh.positions.size(), 0);
    found.errors_px.assign(mesh.positions.size(), -1.0F);
    parallel_for(mesh.positions.size(), [&](std::size_t vertex) {
        const std::uint32_t point = mesh.points[vertex];
        if (point == kNoPoint) return;
        found.num_views[vertex] = static_cast<std::int32_t>(scene.tracks[point].size());
        if (!is_of_model(point, scene)) return;
        found.point_ids[vertex] = static_cast<std::int64_t>(scene.point_ids[point]);
        const double error = scene.errors_px[point];
        found.errors_px[vertex] = error < 0.0 ? -1.0F : static_cast<float>(error);
    });
    found.supports = face_supports(mesh, scene);
    return found;
}

ViewAgreement view_agreement(const HalfEdgeMesh& mesh, const Scene& scene)
{
    return parallel_sum(
        mesh.n_faces(), ViewAgreement(),
        [&](std::size_t i) {
            const auto face = handle_at<OpenMesh::FaceHandle>(i);
            return mesh.is_deleted(face) ? ViewAgreement() : agreement_of_face(mesh, scene, face);
        },
        sum);
}

} // namespace vcarve
