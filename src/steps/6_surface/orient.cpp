#include "steps/6_surface/orient.h"

#include "base/parallel.h"
#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"

#include <Eigen/Geometry>

namespace vcarve {

namespace {

using Eigen::Vector3d;

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
            ++agreement.sights;
            agreement.facing += normal.dot(scene.views[view].center - mesh.point(vertex)) > 0.0;
        }
    }
    return agreement;
}

ViewAgreement sum(const ViewAgreement& a, const ViewAgreement& b)
{
    return {.sights = a.sights + b.sights, .facing = a.facing + b.facing};
}

} // namespace

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
