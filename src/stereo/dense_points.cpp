#include "stereo/dense_points.h"

#include "base/parallel.h"
#include "base/progress.h"
#include "picture/first_faces.h"
#include "stereo/choose_sources.h"
#include "stereo/filter_depth.h"
#include "stereo/fuse.h"
#include "stereo/patch_match.h"
#include "stereo/stereo_view.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace vcarve {

namespace {

using Eigen::Vector3d;

constexpr std::size_t kNeighbors = 10; ///< that fusion compares with
constexpr std::size_t kSources = 5;    ///< of these that are matched
constexpr int kSmallestRegion = 40;    ///< pixels of a depth map

/// Looks up the sparse surface along rays.
class SurfaceDepth {
  public:
    explicit SurfaceDepth(const TriMesh& mesh) : mesh_(mesh), faces_(mesh, center_of(mesh)) {}

    PixelPlane plane(const StereoView& view, int x, int y) const
    {
        constexpr float kLeastFacing = 0.1F;
        const Eigen::Vector3f ray =
            view.camera.ray(static_cast<float>(x * kDepthStep), static_cast<float>(y * kDepthStep));
        const Vector3d direction =
            (view.cam_from_world.transpose() * ray.cast<double>()).normalized();
        const FirstFace hit = faces_.from(view.center, direction);
        if (hit.face == FirstFace::kNone) return {};
        const auto& [a, b, c] = mesh_.faces[hit.face];
        const Vector3d& first = mesh_.positions[a];
        const Vector3d right = mesh_.positions[b] - first;
        const Vector3d left = mesh_.positions[c] - first;
        const Vector3d position = first + hit.second * right + hit.third * left;
        PixelPlane plane;
        plane.depth = static_cast<float>(view.cam_from_world.row(2).dot(position - view.center));
        Eigen::Vector3f normal =
            (view.cam_from_world * right.cross(left).normalized()).cast<float>();
        if (normal.dot(ray) > 0.0F) normal = -normal;
        if (-normal.dot(ray) >= kLeastFacing * ray.norm()) plane.normal = normal;
        return plane;
    }

  private:
    static Vector3d center_of(const TriMesh& mesh)
    {
        Eigen::AlignedBox3d box;
        for (const Vector3d& position : mesh.positions) {
            box.extend(position);
        }
        return mesh.positions.empty() ? Vector3d(Vector3d::Zero()) : Vector3d(box.center());
    }

    const TriMesh& mesh_;
    FirstFaces faces_;
};

/// The depths of the points that each view sees.
std::vector<std::vector<float>> depths_of_points(const Scene& scene)
{
    std::vector<std::vector<float>> depths(scene.views.size());
    for (std::size_t point = 0; point < scene.num_points(); ++point) {
        for (const std::uint32_t index : scene.tracks[point]) {
            const View& view = scene.views[index];
            const Vector3d in_cam = view.cam_from_world * (scene.positions[point] - view.center);
            if (in_cam.z() > 0.0) depths[index].push_back(static_cast<float>(in_cam.z()));
        }
    }
    return depths;
}

DepthPrior prior_of(const StereoView& view, std::vector<float> depths, const SurfaceDepth* surface)
{
    DepthPrior prior;
    std::ranges::sort(depths);
    const std::size_t tail = depths.size() / 50;
    prior.nearest = 0.8F * depths[tail];
    prior.farthest = 1.3F * depths[depths.size() - 1 - tail];
    const int width = (view.image.width_px + kDepthStep - 1) / kDepthStep;
    const int height = (view.image.height_px + kDepthStep - 1) / kDepthStep;
    for (int y = 0; surface != nullptr && y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            prior.surface.push_back(surface->plane(view, x, y));
        }
    }
    return prior;
}

void add_measured(const Scene& sparse, Scene& dense)
{
    for (std::size_t point = 0; point < sparse.num_points(); ++point) {
        if (sparse.kind_of(point) != PointKind::measured) continue;
        dense.positions.push_back(sparse.positions[point]);
        dense.colors.push_back(sparse.colors[point]);
        dense.errors_px.push_back(-1.0);
        dense.normals.push_back(Eigen::Vector3f::Zero());
        dense.point_ids.push_back(dense.point_ids.size());
        dense.tracks.push_back(sparse.tracks[point]);
    }
}

} // namespace

Scene dense_points(const Scene& sparse, const TriMesh& surface,
                   const std::vector<CalibratedPhoto>& photos, const StereoOptions& options,
                   Log& log)
{
    std::vector<StereoView> views(photos.size());
    {
        Stage stage(log, "photographs");
        parallel_for(
            photos.size(), stage,
            [&](std::size_t i) { views[i] = stereo_view(photos[i], options.size_px); }, 1);
        stage.end({{"photographs", size_of(photos.size())}});
    }
    std::vector<DepthMap> maps(views.size());
    std::vector<std::vector<std::uint32_t>> neighbors;
    {
        Stage stage(log, "depth");
        neighbors = choose_sources(sparse, views, kNeighbors);
        const std::vector<std::vector<float>> depths = depths_of_points(sparse);
        const SurfaceDepth faces(surface);
        const auto match = [&](std::size_t i) {
            DepthMap& map = maps[i];
            map.width_px = (views[i].image.width_px + kDepthStep - 1) / kDepthStep;
            map.height_px = (views[i].image.height_px + kDepthStep - 1) / kDepthStep;
            map.planes.resize(static_cast<std::size_t>(map.width_px) * map.height_px);
            map.costs.assign(map.planes.size(), DepthMap::kNoCost);
            if (neighbors[i].size() < 2 || depths[views[i].view].empty()) return;
            std::vector<const StereoView*> sources;
            for (const std::uint32_t neighbor : neighbors[i]) {
                if (sources.size() < kSources) sources.push_back(&views[neighbor]);
            }
            map = match_view(views[i], sources, prior_of(views[i], depths[views[i].view], &faces));
            for (float& cost : map.costs) {
                if (cost > 0.35F) cost = DepthMap::kNoCost;
            }
            drop_speckles(map, kSmallestRegion);
        };
        parallel_for(views.size(), stage, match, 1);
        stage.end({{"depth maps", size_of(maps.size())}});
    }
    Stage stage(log, "fuse");
    Scene dense = fuse(sparse, {views, maps, neighbors}, stage);
    stage.end({{"points", size_of(dense.num_points())}});
    add_measured(sparse, dense);
    return dense;
}

} // namespace vcarve
