#include "mesh/first_faces.h"

#include "base/parallel.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>
#include <stdexcept>
#include <type_traits>

namespace vcarve {

namespace {

using Corner = std::array<float, 3>;

struct ReleaseDevice {
    void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
using DeviceHandle = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;

/// Throws the first error of a device; for a null device, the error of creating it.
void require_success(RTCDevice device)
{
    const RTCError error = rtcGetDeviceError(device);
    if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    if (error != RTC_ERROR_NONE) {
        throw std::runtime_error(
            fmt::format("Embree failed with error {}", static_cast<int>(error)));
    }
}

template <typename Item>
Item* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count)
{
    return static_cast<Item*>(
        rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(Item), count));
}

/// Scales lengths to at most about 1, so that lengths and their products are in the range of float.
double scale_of(const TriMesh& mesh, const Eigen::Vector3d& eye)
{
    double farthest = 0.0;
    for (const Eigen::Vector3d& position : mesh.positions) {
        farthest = std::max(farthest, (position - eye).lpNorm<Eigen::Infinity>());
    }
    return farthest > 0.0 ? 1.0 / farthest : 1.0;
}

void fill_corners(const TriMesh& mesh, const Eigen::Vector3d& eye, double scale, Corner* corners)
{
    parallel_for(mesh.positions.size(), [&](std::size_t i) {
        const Eigen::Vector3f corner = (scale * (mesh.positions[i] - eye)).cast<float>();
        corners[i] = {corner.x(), corner.y(), corner.z()};
    });
}

/// Rejects hits on back faces, so that the ray continues.
void pass_backs(const RTCFilterFunctionNArguments* found)
{
    const RTCRay ray = rtcGetRayFromRayN(found->ray, found->N, 0);
    const RTCHit hit = rtcGetHitFromHitN(found->hit, found->N, 0);
    const float along = ray.dir_x * hit.Ng_x + ray.dir_y * hit.Ng_y + ray.dir_z * hit.Ng_z;
    if (!(along < 0.0F)) found->valid[0] = 0;
}

#if RTC_VERSION_MAJOR >= 4
constexpr auto kFilterFlag = RTC_SCENE_FLAG_FILTER_FUNCTION_IN_ARGUMENTS;

void intersect(RTCScene scene, RTCRayHit& query, RTCFilterFunctionN filter)
{
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    if (filter != nullptr) {
        arguments.filter = filter;
        arguments.flags = static_cast<RTCRayQueryFlags>(RTC_RAY_QUERY_FLAG_COHERENT |
                                                        RTC_RAY_QUERY_FLAG_INVOKE_ARGUMENT_FILTER);
    }
    rtcIntersect1(scene, &query, &arguments);
}
#else
constexpr auto kFilterFlag = RTC_SCENE_FLAG_CONTEXT_FILTER_FUNCTION;

void intersect(RTCScene scene, RTCRayHit& query, RTCFilterFunctionN filter)
{
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    context.filter = filter;
    rtcIntersect1(scene, &context, &query);
}
#endif

} // namespace

struct FirstFaces::Tree {
    DeviceHandle device;
    SceneHandle scene;
};

FirstFaces::FirstFaces(const TriMesh& mesh, const Eigen::Vector3d& eye)
    : tree_(std::make_unique<Tree>()), eye_(eye), scale_(scale_of(mesh, eye))
{
    if (mesh.faces.empty()) return;
    tree_->device.reset(rtcNewDevice(nullptr));
    RTCDevice device = tree_->device.get();
    require_success(device);
    tree_->scene.reset(rtcNewScene(device));
    RTCScene scene = tree_->scene.get();
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST | kFilterFlag);

    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* corners = new_buffer<Corner>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3,
                                       mesh.positions.size());
    auto* faces =
        new_buffer<Face>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh.faces.size());
    require_success(device);
    fill_corners(mesh, eye, scale_, corners);
    std::ranges::copy(mesh.faces, faces);
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    // With several threads the tree would depend on their timing, and the tree decides which of two
    // equally distant faces is hit.
    tbb::task_arena one_thread(1);
    one_thread.execute([&] { rtcCommitScene(scene); });
    require_success(device);
}

FirstFaces::~FirstFaces() = default;

FirstFace FirstFaces::first(const Eigen::Vector3f& start, const Eigen::Vector3d& direction,
                            bool only_fronts) const
{
    if (!tree_->scene) return {};
    RTCRayHit query{};
    query.ray.org_x = start.x();
    query.ray.org_y = start.y();
    query.ray.org_z = start.z();
    const Eigen::Vector3f towards = direction.cast<float>();
    query.ray.dir_x = towards.x();
    query.ray.dir_y = towards.y();
    query.ray.dir_z = towards.z();
    query.ray.tfar = std::numeric_limits<float>::infinity();
    query.ray.mask = std::numeric_limits<unsigned>::max();
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    intersect(tree_->scene.get(), query, only_fronts ? pass_backs : nullptr);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.primID, query.hit.u, query.hit.v};
}

FirstFace FirstFaces::along(const Eigen::Vector3d& direction) const
{
    return first(Eigen::Vector3f::Zero(), direction, false);
}

FirstFace FirstFaces::front_along(const Eigen::Vector3d& direction) const
{
    return first(Eigen::Vector3f::Zero(), direction, true);
}

FirstFace FirstFaces::from(const Eigen::Vector3d& place, const Eigen::Vector3d& direction) const
{
    return first((scale_ * (place - eye_)).cast<float>(), direction, false);
}

} // namespace vcarve
