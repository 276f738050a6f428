#include "steps/5_surface/orient.h"

#include "geometry/triangle.h"
#include "mesh/half_edge_mesh.h"

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

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
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_reduce(
        Range(0, mesh.n_faces(), 1024), ViewAgreement(),
        [&](const Range& range, ViewAgreement agreement) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                const auto face = handle_at<OpenMesh::FaceHandle>(i);
                if (mesh.is_deleted(face)) continue;
                agreement = sum(agreement, agreement_of_face(mesh, scene, face));
            }
            return agreement;
        },
        sum);
}

} // namespace vcarve
