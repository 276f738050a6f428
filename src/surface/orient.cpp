#include "surface/orient.h"

#include "base/parallel.h"

#include <Eigen/Geometry>

#include <atomic>

namespace vcarve {

namespace {

using Eigen::Vector3d;

ViewAgreement agreement_of_face(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    ViewAgreement agreement;
    const Vector3d& a = mesh.positions[face[0]];
    const Vector3d normal = (mesh.positions[face[1]] - a).cross(mesh.positions[face[2]] - a);
    for (const std::uint32_t vertex : face) {
        const std::uint32_t point = mesh.points[vertex];
        if (point == kNoPoint) {
            continue;
        }
        for (const std::uint32_t view : scene.tracks[point]) {
            ++agreement.sights;
            agreement.facing += normal.dot(scene.views[view].center - mesh.positions[vertex]) > 0.0;
        }
    }
    return agreement;
}

} // namespace

ViewAgreement view_agreement(const TriMesh& mesh, const Scene& scene)
{
    std::atomic<std::int64_t> sights = 0;
    std::atomic<std::int64_t> facing = 0;
    parallel_for(mesh.faces.size(), [&](std::size_t i) {
        const ViewAgreement found = agreement_of_face(mesh, scene, mesh.faces[i]);
        sights.fetch_add(found.sights, std::memory_order_relaxed);
        facing.fetch_add(found.facing, std::memory_order_relaxed);
    });
    return {sights, facing};
}

} // namespace vcarve
