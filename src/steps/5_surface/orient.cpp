#include "steps/5_surface/orient.h"

#include "geometry/triangle.h"

#include <Eigen/Geometry>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

namespace vcarve {

namespace {

using Eigen::Vector3d;

ViewAgreement agreement_of_face(const TriMesh& mesh, const Scene& scene, const Face& face)
{
    ViewAgreement agreement;
    const Vector3d normal = scaled_normal(mesh.positions, face);
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

ViewAgreement sum(const ViewAgreement& a, const ViewAgreement& b)
{
    return {.sights = a.sights + b.sights, .facing = a.facing + b.facing};
}

} // namespace

ViewAgreement view_agreement(const TriMesh& mesh, const Scene& scene)
{
    using Range = tbb::blocked_range<std::size_t>;
    return tbb::parallel_reduce(
        Range(0, mesh.faces.size(), 1024), ViewAgreement(),
        [&](const Range& range, ViewAgreement agreement) {
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
                agreement = sum(agreement, agreement_of_face(mesh, scene, mesh.faces[i]));
            }
            return agreement;
        },
        sum);
}

} // namespace vcarve
